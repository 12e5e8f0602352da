"""Cut a mesh open along a way of edges, corner by corner."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from meshjig.mesh.halfedges import edges, next_halfedge

__all__ = ["halfedges_along", "left_corners"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


def halfedges_along(F: Ints, way: Ints) -> Ints:
    """List the half-edges that run along a way of vertices, in its direction and against it."""
    n = np.int64(int(F.max()) + 1)
    a, b = F.ravel(), F[:, [1, 2, 0]].ravel()
    steps = np.concatenate([way[:-1] * n + way[1:], way[1:] * n + way[:-1]])
    return np.flatnonzero(np.isin(a * n + b, steps))


def left_corners(F: Ints, way: Ints) -> Bools:
    """Mark the corners that lie on the left of a way.

    Parameters
    ----------
    F : (m, 3) int64, manifold
    way : (k,) int64, vertices, each once; at its ends it reaches the border, and nowhere else. An
        end inside the mesh has nothing on its left.

    Returns
    -------
    (m, 3) bool
    """
    on_way = np.zeros(int(F.max()) + 1, bool)
    on_way[way] = True
    touching = np.flatnonzero(on_way[F].any(1))
    G = F[touching]
    twin = edges(G).twin
    along = halfedges_along(G, way)
    h = np.flatnonzero(twin > np.arange(len(twin)))
    h = np.setdiff1d(h, along)
    t = twin[h]
    rows, cols = np.append(h, next_halfedge(h)), np.append(next_halfedge(t), t)
    graph = coo_matrix((np.ones(len(rows), np.int8), (rows, cols)), shape=(G.size, G.size))
    n, fan = connected_components(graph, directed=False)
    place = np.full(len(on_way), -1)
    place[way] = np.arange(len(way))
    tail, head = place[G.ravel()[along]], place[G.ravel()[next_halfedge(along)]]
    forth = head == tail + 1
    is_left, is_right = np.zeros(n, bool), np.zeros(n, bool)
    for side, some in ((is_left, along[forth]), (is_right, along[~forth])):
        side[fan[some]] = side[fan[next_halfedge(some)]] = True
    left = np.zeros(F.shape, bool)
    left[touching] = (is_left & ~is_right)[fan].reshape(-1, 3) & on_way[G]
    return left
