"""Distances along a surface: shortest paths over its edges and over pairs of faces laid flat."""

from typing import Any

import numpy as np

from meshjig.mesh.halfedges import Edges, next_halfedge
from meshjig.mesh.measure import vertex_normals
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["far_apart", "nearest", "surface_graph", "turns", "within"]

_GENTLE = np.radians(8)  # a turn from one vertex to the next that is no crease
_APART = 3.0  # spacings between the sources of one search
_REACH = 1.5  # spacings around a source that are searched


def surface_graph(V: Floats, F: Ints, e: Edges, bend: float = 0.0) -> Any:
    """Join vertices by the edges of a mesh and, straight across each edge, the two corners opposite it.

    Shortest paths over this graph are within a few per cent of the geodesic distance.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    e : Edges, of F
    bend : float, mm
        What a radian costs that the surface turns by on the way; gentle turns cost nothing.

    Returns
    -------
    scipy.sparse.csr_matrix, (n, n), symmetric, mm
    """
    from scipy.sparse import csr_matrix

    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    ends = e.E[e.edge_of_halfedge[h]]
    opposite = np.stack([_opposite(F, h), _opposite(F, e.twin[h])], 1)
    length, straight = _unfolded(V, ends, opposite)
    pairs = np.concatenate([e.E, opposite[straight]])
    far = np.concatenate([np.linalg.norm(V[e.E[:, 0]] - V[e.E[:, 1]], axis=1), length[straight]])
    if bend:
        far = far + bend * turns(V, F, pairs)
    key = pairs.min(1) * len(V) + pairs.max(1)
    order = np.lexsort((far, key))
    first = np.ones(len(key), bool)  # of two ways between the same vertices, the shorter
    first[1:] = np.diff(key[order]) > 0
    a, b = pairs[order[first]].T
    far = np.maximum(far[order[first]], 1e-9)  # an entry of 0 would be no edge
    return csr_matrix((np.tile(far, 2), (np.r_[a, b], np.r_[b, a])), shape=(len(V), len(V)))


def turns(V: Floats, F: Ints, pairs: Ints) -> Floats:
    """Give by how much the surface turns from one vertex to another, (k,), radians; gentle turns are 0."""
    N = vertex_normals(V, F)
    angle = np.arccos(np.clip(np.einsum("ij,ij->i", N[pairs[:, 0]], N[pairs[:, 1]]), -1, 1))
    return np.maximum(angle - _GENTLE, 0.0)


def nearest(graph: Any, sources: Ints) -> Ints:
    """Give the nearest of the sources (k,) for every vertex, (n,), 0 to k - 1; -1 where none is joined."""
    return _search(graph, sources, np.inf)[0]


def within(V: Floats, graph: Any, sources: Ints, spacing: float, kept: int = 6) -> tuple[Ints, Floats]:
    """Give the sources nearest to each vertex and how far away they are.

    Sources that lie far apart share a search, so the cost hardly depends on their number.

    Parameters
    ----------
    V : (n, 3) float64, mm
    graph : from surface_graph
    sources : (k,) int64, vertices, all different
    spacing : float, mm, about the distance between sources
    kept : int

    Returns
    -------
    source : (n, kept) int64, nearest first, 0 to k - 1; -1 where there are fewer
    distance : (n, kept) float64, mm; infinite there
    """
    group = far_apart(V[sources], _APART * spacing)
    closest, far = _search(graph, sources, np.inf)
    lonely = np.flatnonzero((far > _REACH * spacing) & (closest >= 0))  # no search below gets there
    vertex, source, distance = [lonely], [closest[lonely]], [far[lonely]]
    for g in range(int(group.max()) + 1):
        members = np.flatnonzero(group == g)
        found, far = _search(graph, sources[members], _REACH * spacing)
        at = np.flatnonzero(found >= 0)
        vertex.append(at)
        source.append(members[found[at]])
        distance.append(far[at])
    return _nearest_of(np.concatenate(vertex), np.concatenate(source), np.concatenate(distance), len(V), kept)


def _opposite(F: Ints, h: Ints) -> Ints:
    return F.ravel()[next_halfedge(next_halfedge(h))]


def _unfolded(V: Floats, ends: Ints, opposite: Ints) -> tuple[Floats, Bools]:
    """Lay both faces of edges flat: how far apart their far corners are, and whether the edge is between."""
    start = V[ends[:, 0]]
    along = V[ends[:, 1]] - start
    length = np.maximum(np.linalg.norm(along, axis=1), 1e-300)
    x, y = np.empty((2, len(ends))), np.empty((2, len(ends)))
    for k in range(2):
        p = V[opposite[:, k]] - start
        x[k] = np.einsum("ij,ij->i", p, along) / length
        y[k] = np.sqrt(np.maximum(np.einsum("ij,ij->i", p, p) - x[k] ** 2, 0.0))
    across = x[0] + (x[1] - x[0]) * y[0] / np.maximum(y[0] + y[1], 1e-300)
    return np.hypot(x[1] - x[0], y[0] + y[1]), (across > 0) & (across < length)


def _search(graph: Any, sources: Ints, limit: float) -> tuple[Ints, Floats]:
    from scipy.sparse.csgraph import dijkstra

    number = np.full(graph.shape[0] + 1, -1)
    number[sources] = np.arange(len(sources))
    far, _, source = dijkstra(graph, indices=sources, min_only=True, return_predecessors=True, limit=limit)
    return number[np.where(np.isfinite(far), source, -1)], far


def far_apart(points: Floats, apart: float) -> Ints:
    """Group points so that no two of a group are closer than apart, (k,)."""
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(apart, output_type="ndarray")
    near: list[list[int]] = [[] for _ in points]
    for a, b in pairs.tolist():
        near[max(a, b)].append(min(a, b))
    group = [0] * len(points)
    for i, others in enumerate(near):
        taken = {group[j] for j in others}
        while group[i] in taken:
            group[i] += 1
    return np.array(group, np.int64)


def _nearest_of(vertex: Ints, source: Ints, distance: Floats, n: int, kept: int) -> tuple[Ints, Floats]:
    order = np.lexsort((distance, vertex))
    vertex, source, distance = vertex[order], source[order], distance[order]
    rank = np.arange(len(vertex)) - np.searchsorted(vertex, np.arange(n))[vertex]
    near = rank < kept
    sources = np.full((n, kept), -1)
    distances = np.full((n, kept), np.inf)
    sources[vertex[near], rank[near]] = source[near]
    distances[vertex[near], rank[near]] = distance[near]
    return sources, distances
