"""Tutte's embedding: flatten a disc-shaped chart onto a round disc, never with a mirrored face."""

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.boundary_loops import border_loop
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas

__all__ = ["tutte"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def tutte(V: Floats, F: Ints) -> Floats:
    """Put the border on a circle and every other vertex at the mean of its neighbours.

    The shape is poor, but it is a valid start for maps that can't repair mirrored faces.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex

    Returns
    -------
    uv : (n, 2) float64, mm, on a disc of the chart's area

    References
    ----------
    Tutte, "How to Draw a Graph", 1963.
    """
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import splu

    border = border_loop(F)
    uv = np.zeros((len(V), 2))
    uv[border] = _circle(V[border]) * np.sqrt(face_areas(V, F).sum() / np.pi)
    free = np.setdiff1d(np.arange(len(V)), border)
    if len(free):
        E = edges(F).E
        W = coo_matrix((np.ones(len(E)), (E[:, 0], E[:, 1])), shape=(len(V), len(V)))
        W = (W + W.T).tocsr()
        L = (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()[free]
        solver = splu(L[:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        uv[free] = solver.solve(-(L[:, border] @ uv[border]))
    return uv


def _circle(loop: Floats) -> Floats:
    """Spread a loop's points on the unit circle by arc length; no two of them fall together."""
    length = np.linalg.norm(loop - np.roll(loop, -1, 0), axis=1)
    length = np.maximum(length, 0.05 * length.mean() + 1e-300)
    angle = 2 * np.pi * (np.cumsum(length) - length) / length.sum()
    return np.stack([np.cos(angle), np.sin(angle)], 1)
