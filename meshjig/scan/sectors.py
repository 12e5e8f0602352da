"""What lies around an edge with more than two faces: the faces in turn, and the space between each two."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import Edges, next_halfedge
from meshjig.mesh.measure import unit

__all__ = ["Sectors", "sectors"]

_SAME = 1e-4  # radians; faces at such an angle lie on each other


class Sectors(NamedTuple):
    """The half-edges at crowded edges, in turn around each, counterclockwise seen against its direction."""

    halfedge: Ints  # (k,)
    following: Ints  # (k,), the place in this list of the next one around the same edge
    forward: Bools  # (k,), runs along its edge: the back of its face, where the material is, comes before it


def sectors(V: Floats, F: Ints, e: Edges, patch: Ints | None = None) -> Sectors:
    """Order the faces around every edge that has more than two.

    Of faces that lie on each other, those whose material comes before them are first: two bodies that
    touch there are kept apart.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, no face with a repeated corner
    e : Edges, of F
    patch : (m,) int64, part of the surface that each face is in; of two parts that lie on each other and
        turn the same way, one is in front of the other all over

    Returns
    -------
    Sectors
    """
    h = np.flatnonzero(e.n_faces[e.edge_of_halfedge] > 2)
    edge = e.edge_of_halfedge[h]
    h, edge = (x[np.argsort(edge, kind="stable")] for x in (h, edge))
    a, b = e.E[edge].T
    axis = unit(V[b] - V[a])
    across = V[F.ravel()[next_halfedge(next_halfedge(h))]] - V[a]
    across -= np.einsum("ij,ij->i", across, axis)[:, None] * axis
    start = np.searchsorted(edge, edge)
    u = unit(across)[start]  # angles count from the first face
    v = np.cross(axis, u)
    angle = np.arctan2(np.einsum("ij,ij->i", across, v), np.einsum("ij,ij->i", across, u))
    angle = (angle + _SAME) % (2 * np.pi)
    forward = F.ravel()[h] == a
    order = np.lexsort([angle, edge])
    step = np.diff(angle[order], prepend=0.0)
    layer = np.cumsum((step > _SAME) | (step < 0))
    rank = np.zeros(len(h), np.int64) if patch is None else patch[h // 3] * np.where(forward, 1, -1)
    order = order[np.lexsort([rank[order], ~forward[order], layer, edge[order]])]
    count = np.searchsorted(edge, edge, side="right") - start
    following = start + (np.arange(len(h)) - start + 1) % np.maximum(count, 1)
    return Sectors(h[order], following, forward[order])
