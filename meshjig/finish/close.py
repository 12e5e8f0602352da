"""Close a sheet over its openings."""

from __future__ import annotations

import numpy as np

from meshjig.measure import face_areas
from meshjig.topology import border_halfedges, next_halfedge
from meshjig.types import Floats, Ints

__all__ = ["closed_over"]


def closed_over(V: Floats, F: Ints) -> tuple[Floats, Ints, float]:
    """Close every opening by a fan around its middle.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold

    Returns
    -------
    V : (n + k, 3) float64, mm
    F : (m + c, 3) int64, without a border
    area : float, mm2, of the fans
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    h = border_halfedges(F)
    if not len(h):
        return V, F, 0.0
    a, b = F.ravel()[h], F.ravel()[next_halfedge(h)]
    graph = coo_matrix((np.ones(len(h), np.int8), (a, b)), shape=(len(V), len(V)))
    label = connected_components(graph, directed=False)[1]
    loop = np.unique(label[a], return_inverse=True)[1].ravel()
    n = int(loop.max()) + 1
    middle = np.stack([np.bincount(loop, x, n) for x in V[a].T], 1) / np.bincount(loop, minlength=n)[:, None]
    fans = np.stack([b, a, len(V) + loop], 1)
    V = np.concatenate([V, middle])
    return V, np.concatenate([F, fans]), float(face_areas(V, fans).sum())
