"""Join hanging vertices: those on an edge of the face across, as a fine half beside a coarse one has."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints, ragged, row_of, starts
from meshjig.mesh.halfedges import Edges, edges

__all__ = ["join_hanging"]

_ROUNDS = 8  # one edge of a face in each; a face has three
_SHORTEST = 4.0  # tolerances; shorter edges are left alone
_MOST_PAIRS = 2_000_000  # of an edge and a vertex near it, looked at in one go


class _Hanging(NamedTuple):
    """Vertices on border edges, those of one edge one after the other, from its start to its end."""

    halfedge: Ints  # (k,)
    vertex: Ints  # (k,)


def join_hanging(V: Floats, F: Ints, tolerance: float, e: Edges | None = None) -> tuple[Ints, int]:
    """Split border edges, and the faces along them, at the border vertices that lie on them.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, whose border vertices are welded
    tolerance : float, a distance in the units of V
    e : Edges, of F, where the caller has them

    Returns
    -------
    F : (m', 3) int64, the faces that were split first of all replaced; V stays as it is
    n_joined : int, times that a vertex lay on an edge
    """
    joined = 0
    for _ in range(_ROUNDS):
        found = _on_border_edges(V, F, tolerance, e or edges(F))
        e = None
        if not len(found.halfedge):
            break
        first_of_face = np.unique(found.halfedge // 3, return_index=True)[1]
        now = np.isin(found.halfedge, found.halfedge[first_of_face])
        F = _split(F, found.halfedge[now], found.vertex[now])
        joined += int(now.sum())
    return F, joined


def _on_border_edges(V: Floats, F: Ints, tolerance: float, e: Edges) -> _Hanging:
    """Find the border vertices that lie inside border edges."""
    from scipy.spatial import cKDTree

    none: Ints = np.zeros(0, np.int64)
    h = np.flatnonzero(e.n_faces[e.edge_of_halfedge] == 1)
    if not len(h):
        return _Hanging(none, none)
    at = np.unique(e.E[e.n_faces == 1])
    tree = cKDTree(V[at])
    a, b = V[F.ravel()[h]], V[F[h // 3, (h + 1) % 3]]
    middle, radius = (a + b) / 2, np.linalg.norm(b - a, axis=1) / 2 + tolerance
    near = tree.query_ball_point(middle, radius, return_length=True)
    some = np.flatnonzero((near > 2) & (2 * radius > _SHORTEST * tolerance))  # two are its own ends
    found = [none], [none]
    for part in np.array_split(some, int(near[some].sum()) // _MOST_PAIRS + 1):
        lists = tree.query_ball_point(middle[part], radius[part])
        edge = part[row_of(np.array([len(x) for x in lists], np.int64))]
        vertex = at[np.concatenate([none, *lists]).astype(np.int64)]
        along, aside = _along(V[vertex], a[edge], b[edge])
        inside = (along > tolerance) & (along < 2 * radius[edge] - 3 * tolerance) & (aside <= tolerance)
        inside &= ~(F[h[edge] // 3] == vertex[:, None]).any(1)
        order = np.lexsort([along[inside], edge[inside]])
        found[0].append(h[edge[inside]][order])
        found[1].append(vertex[inside][order])
    return _Hanging(np.concatenate(found[0]), np.concatenate(found[1]))


def _along(P: Floats, a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Give how far points are along their edges from a to b, and how far aside of them, (k,) each."""
    length = np.linalg.norm(b - a, axis=1)
    axis = (b - a) / np.maximum(length, 1e-300)[:, None]
    along = np.einsum("ij,ij->i", P - a, axis)
    return along, np.linalg.norm(P - a - along[:, None] * axis, axis=1)


def _split(F: Ints, h: Ints, vertex: Ints) -> Ints:
    """Split faces into fans along one edge each, given half-edges and the vertices on them in order."""
    edge, count = np.unique(h, return_counts=True)
    face, k = edge // 3, edge % 3
    n = count + 1  # parts of each edge
    tail = np.empty(int(n.sum()), np.int64)
    head = np.empty_like(tail)
    first, inner = starts(n), ragged(starts(n) + 1, count)
    tail[first], tail[inner] = F[face, k], vertex
    head[inner - 1], head[first + count] = vertex, F[face, (k + 1) % 3]
    apex = np.repeat(F[face, (k + 2) % 3], n)
    fans = np.stack([tail, head, apex], 1)
    whole = np.ones(len(F), bool)
    whole[face] = False
    return np.concatenate([F[whole], fans])
