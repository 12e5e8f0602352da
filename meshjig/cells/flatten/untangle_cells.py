"""Small folds of a flattening smoothed out: slivers that came out mirrored."""

import numpy as np

from meshjig.cells.flatten.planar import Patches, mirrored
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import sums
from meshjig.mesh.types import Floats

__all__ = ["unfolded"]

_ROUNDS = 6  # in each of which what moves grows by a ring where it has to
_SHORTEST = 1e-6  # mm


def unfolded(p: Patches, uv: Floats) -> Floats:
    """Move the vertices of mirrored faces, and as few around them as it takes, between their neighbours.

    Each comes to a mean of its neighbours in which near ones count for more, as in Tutte's embedding:
    where what surrounds them is convex, no face among them is mirrored. Rims stay as they are, so that
    not every fold can be undone; a cell in which more would be mirrored than before stays as it is.

    Parameters
    ----------
    p : Patches
    uv : (k, 2) float64, mm

    Returns
    -------
    (k, 2) float64, mm
    """
    from scipy.sparse import csr_matrix
    from scipy.sparse.linalg import spsolve

    e = edges(p.F)
    inner = np.ones(len(p.V), bool)
    inner[e.E[e.n_faces == 1]] = False
    a, b = e.E.T
    w = 1 / np.maximum(np.linalg.norm(p.V[a] - p.V[b], axis=1), _SHORTEST)
    W = csr_matrix((np.r_[w, w], (np.r_[a, b], np.r_[b, a])), shape=(len(p.V), len(p.V)))
    free = np.zeros(len(p.V), bool)
    start, uv = uv, uv.copy()
    for turn in range(_ROUNDS):
        fold = mirrored(p, uv)
        if not fold.any():
            break
        if turn:
            around = np.isin(p.F, p.F[fold])
            fold = around[:, 0] | around[:, 1] | around[:, 2]
        free[p.F[fold]] = True
        moving = np.flatnonzero(free & inner)
        if not len(moving):
            break
        row = W[moving]
        total = np.asarray(row.sum(1)).ravel()
        A = csr_matrix((total, (np.arange(len(moving)),) * 2), shape=(len(moving),) * 2) - row[:, moving]
        fixed = uv.copy()
        fixed[moving] = 0.0
        uv[moving] = spsolve(A.tocsc(), row @ fixed).reshape(-1, 2)
    better = _fold_area(p, uv) <= _fold_area(p, start)
    return np.where(better[p.of_vertex, None], uv, start)


def _fold_area(p: Patches, uv: Floats) -> Floats:
    """Give the area in space of the mirrored faces of each cell, (n,)."""
    return sums(p.cell, p.area * mirrored(p, uv), p.n)
