"""Tutte's embedding of many cells at once: round discs, never with a mirrored face."""

import numpy as np

from meshjig.cells.flatten.planar import Patches, rims, scaled
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import sums
from meshjig.mesh.types import Floats, Ints

__all__ = ["tutte"]


def tutte(p: Patches) -> Floats:
    """Put the border of every cell on a circle and all else at the mean of its neighbours.

    Parameters
    ----------
    p : Patches, discs

    Returns
    -------
    uv : (k, 2) float64, mm, each cell of its own area

    References
    ----------
    Tutte, "How to Draw a Graph", 1963.
    """
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import splu

    E, k = edges(p.F).E, len(p.V)
    W = coo_matrix((np.ones(len(E)), (E[:, 0], E[:, 1])), shape=(k, k)).tocsr()
    W = W + W.T
    uv, border = np.zeros((k, 2)), np.zeros(k, bool)
    rim, _ = rims(p)
    of_rim = p.of_vertex[rim]
    count = np.bincount(of_rim, minlength=p.n)
    step = np.linalg.norm(p.V[rim] - p.V[_following(rim, count)], axis=1)
    step = np.maximum(step, (0.05 * sums(of_rim, step, p.n) / count)[of_rim])  # no two fall together
    total = sums(of_rim, step, p.n)
    along = np.cumsum(step) - step - (np.cumsum(total) - total)[of_rim]
    angle = 2 * np.pi * along / total[of_rim]
    uv[rim], border[rim] = np.stack([np.cos(angle), np.sin(angle)], 1), True
    free = np.flatnonzero(~border)
    if len(free):
        L = (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()[free]
        solver = splu(L[:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        uv[free] = solver.solve(-(L[:, border] @ uv[border]))
    return scaled(p, uv)


def _following(rim: Ints, count: Ints) -> Ints:
    """Give the vertex that comes after each one of its loop."""
    last = np.cumsum(count) - 1
    after = np.append(rim[1:], rim[:1])
    after[last] = rim[last + 1 - count]
    return after
