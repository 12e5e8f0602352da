"""Straighten borders: points on edges slide along them until the border runs straight on."""

import numpy as np

from meshjig.mesh.halfedges import Edges
from meshjig.mesh.types import Floats, Ints

__all__ = ["straightened"]

_ROUNDS = 12


def straightened(V: Floats, e: Edges, cell: Ints, point: Ints, ends: Ints, near: float) -> Floats:
    """Slide points of borders along the edges that they lie on, each towards the line between its neighbours.

    Parameters
    ----------
    V : (n, 3) float64, mm, vertices of a mesh whose edges follow borders
    e : Edges
    cell : (m,) int64, of each face
    point : (k,) int64, vertices that lie on an edge
    ends : (k, 2) int64, vertices at the ends of that edge
    near : float, 0 to 0.5, of an edge: points stay that far from its ends

    Returns
    -------
    (n, 3) float64, mm
    """
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    border = h[cell[h // 3] != cell[e.twin[h] // 3]]
    E = e.E[e.edge_of_halfedge[border]]
    both = np.concatenate([E, E[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    degree = np.bincount(both[:, 0], minlength=len(V))
    start = np.cumsum(degree) - degree
    moving = degree[point] == 2
    point, ends = point[moving], ends[moving]
    p, q = both[start[point], 1], both[start[point] + 1, 1]
    a, d = V[ends[:, 0]], V[ends[:, 1]] - V[ends[:, 0]]
    squared = np.maximum(np.einsum("ij,ij->i", d, d), 1e-300)
    W = V.copy()
    for _ in range(_ROUNDS):
        x = W[point]
        lp, lq = np.linalg.norm(W[p] - x, axis=1), np.linalg.norm(W[q] - x, axis=1)
        m = (W[p] * lq[:, None] + W[q] * lp[:, None]) / np.maximum(lp + lq, 1e-300)[:, None]
        t = np.clip(np.einsum("ij,ij->i", (m + x) / 2 - a, d) / squared, near, 1 - near)
        W[point] = a + t[:, None] * d
    return W
