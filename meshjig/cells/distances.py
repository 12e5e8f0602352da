"""Distances from many sources at once along a surface, and smooth ones."""

from typing import Any

import numpy as np

from meshjig.cells.surface import Surface
from meshjig.mesh.types import Floats, Ints

__all__ = ["far_apart", "nearest", "smooth_distances", "within"]

_APART = 3.0  # spacings between the sources of one search
_REACH = 1.5  # spacings around a source that are searched
_KEPT = 5  # sources of a vertex that are smoothed: those of the cells that can meet there
_AVERAGED = 0.1  # spacings over which it averages
_ROUNDS = (2, 12)  # of averaging
_ACROSS = 1e-3  # the weight of an edge from a crease to beside it


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


def smooth_distances(s: Surface, near: tuple[Ints, Floats], spacing: float) -> tuple[Ints, Floats]:
    """Average squared distances over a small part of the spacing.

    Shortest paths over edges waver with the triangles. In the plane, the average of a squared distance
    is the squared distance plus the same amount everywhere, so differences keep their place while the
    wavering goes.

    Parameters
    ----------
    s : Surface
    near : the sources near each vertex, (n, k), and their distances, mm; nearest first
    spacing : float, mm

    Returns
    -------
    source : (n, 5) int64, -1 where there are fewer
    distance : (n, 5) float64, mm; infinite there
    """
    from scipy.sparse import csr_matrix

    source = near[0][:, :_KEPT]
    known = source >= 0
    squared = near[1][:, :_KEPT][known] ** 2
    rows, columns = np.nonzero(known)[0], source[known]
    shape = (len(source), int(source.max(initial=0)) + 1)
    value, mask = (csr_matrix((x, (rows, columns)), shape) for x in (squared, np.ones(len(rows))))
    average = _averaging(s)
    edge = float(np.sqrt(4 / np.sqrt(3) * s.area.sum() / len(s.F)))  # of even triangles
    rounds = int(np.clip(round(2 * (_AVERAGED * spacing / edge) ** 2), *_ROUNDS))
    weight = (average @ mask).multiply(mask)
    for _ in range(rounds):
        value = (average @ value).multiply(mask).multiply(weight.power(-1)).tocsr()
    distance = np.full(source.shape, np.inf)
    distance[known] = np.sqrt(np.maximum(np.asarray(value[rows, columns]).ravel(), 0.0))
    return source, distance


def _averaging(s: Surface) -> Any:
    """Give the matrix that averages a value over neighbours, but not over creases, (n, n)."""
    from scipy.sparse import diags, identity

    W = s.weight.copy()
    if s.steep.any():
        rows = np.repeat(np.arange(W.shape[0]), np.diff(W.indptr))
        W.data[s.steep[rows] != s.steep[W.indices]] = _ACROSS
    return ((identity(W.shape[0]) + diags(1 / np.asarray(W.sum(1)).ravel()) @ W) / 2).tocsr()
