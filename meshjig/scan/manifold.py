"""Cut a heap of triangles into sheets: at most two faces an edge, one fan a vertex, no area lost."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import fans
from meshjig.mesh.halfedges import Edges, edges, next_halfedge
from meshjig.scan.sectors import sectors

__all__ = ["ManifoldMesh", "is_clean", "make_manifold"]

_ROUNDS = 100


class ManifoldMesh(NamedTuple):
    """A manifold mesh and what made it one."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    n_edges: int  # edges that had more than two faces
    n_vertices: int  # vertices that were split


def is_clean(F: Ints, n: int, e: Edges | None = None) -> bool:
    """Tell whether faces make a manifold, coherent mesh of n vertices; e are its edges, where they are known.

    That is: every edge has one or two faces, which run along it in opposite directions, and every vertex
    is used, by one fan.
    """
    e = edges(F) if e is None else e
    if e.n_faces.max(initial=0) > 2:
        return False
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    if (F.ravel()[h] == F.ravel()[e.twin[h]]).any():
        return False
    n_fans = np.bincount(fans(F, e.twin)[1], minlength=n)
    return bool(len(n_fans) == n and (n_fans == 1).all())


def make_manifold(V: Floats, F: Ints) -> ManifoldMesh:
    """Pull apart what meets in too many faces.

    Around an edge with more than two faces, those that bound the same side of the material stay
    together, as two boxes that touch in an edge do; faces that are left over end there. Vertices are
    then split by fan. An edge that two sheets still share, because they are connected at both its ends,
    is given a middle of its own in each sheet.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, no face with a repeated corner, no two with equal corners in the same order of turning

    Returns
    -------
    ManifoldMesh
    """
    e = edges(F)
    n_edges = int((e.n_faces > 2).sum())
    n = len(V)
    for _ in range(_ROUNDS):
        twin = _twins(V, F, e)
        F, origin = _fans(F, twin)
        V = V[origin]
        e = edges(F)
        if e.n_faces.max(initial=0) <= 2:
            break
        V, F = _with_middles(V, F, e, twin)
        e = edges(F)
    return ManifoldMesh(V, F, n_edges, max(0, len(V) - n))


def _twins(V: Floats, F: Ints, e: Edges) -> Ints:
    """Each half-edge's twin, also where more than two faces meet; itself where there is none."""
    twin = e.twin.copy()
    h, following, forward = sectors(V, F, e)
    wedge = ~forward & forward[following]  # the material between a backward face and the forward one after it
    twin[h[wedge]], twin[h[following[wedge]]] = h[following[wedge]], h[wedge]
    return twin


def _fans(F: Ints, twin: Ints) -> tuple[Ints, Ints]:
    """Split vertices by fan, see `fans`, in their old order: a clean mesh keeps its numbers."""
    G, old = fans(F, twin)
    order = np.argsort(old, kind="stable")
    number = np.empty(len(order), np.int64)
    number[order] = np.arange(len(order))
    return number[G], old[order]


def _with_middles(V: Floats, F: Ints, e: Edges, twin: Ints) -> tuple[Floats, Ints]:
    """Split crowded edges, in every sheet but the first of each, by a vertex of the sheet's own."""
    h = np.flatnonzero(e.n_faces[e.edge_of_halfedge] > 2)
    sheet = np.minimum(h, twin[h])
    first = np.full(len(e.E), len(twin))
    np.minimum.at(first, e.edge_of_halfedge[h], sheet)
    h = h[sheet != first[e.edge_of_halfedge[h]]]
    sheet = np.minimum(h, twin[h])
    face_first = np.full(len(F), len(twin))
    np.minimum.at(face_first, h // 3, sheet)
    # one split a face and round, and in both faces of a sheet at the same time
    ready = face_first[h // 3] == sheet
    h = h[ready & (np.isin(twin[h], h[ready]))]
    sheets, middle = np.unique(np.minimum(h, twin[h]), return_inverse=True)
    m = len(V) + middle.ravel()
    p, q, r = F[h // 3, h % 3], F[h // 3, (h + 1) % 3], F[h // 3, (h + 2) % 3]
    points = (V[F.ravel()[sheets]] + V[F.ravel()[next_halfedge(sheets)]]) / 2
    G = F.copy()
    G[h // 3] = np.stack([p, m, r], 1)
    return np.concatenate([V, points]), np.concatenate([G, np.stack([m, q, r], 1)])
