"""Shortest ways along the edges of a mesh."""

from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import edge_lengths

__all__ = ["distances", "edge_graph", "path_back", "shortest_way", "symmetric"]


def edge_graph(V: Floats, F: Ints) -> Any:
    """Give the edges as a symmetric sparse matrix of their lengths, (n, n)."""
    E = edges(F).E
    return symmetric(E, edge_lengths(V, E), len(V))


def symmetric(E: Ints, weight: Floats, n: int) -> Any:
    """Give a graph with edges E (e, 2) of given weights; edges without weight are kept."""
    from scipy.sparse import csr_matrix

    rows, cols = np.append(E[:, 0], E[:, 1]), np.append(E[:, 1], E[:, 0])
    # a stored zero would be no edge
    return csr_matrix((np.maximum(np.tile(weight, 2), 1e-12), (rows, cols)), shape=(n, n))


def distances(graph: Any, sources: Ints, limit: float = np.inf) -> Floats:
    """Give the distance of every vertex from the nearest source, (n,); inf beyond a limit."""
    from scipy.sparse.csgraph import dijkstra

    found: Floats = dijkstra(graph, indices=sources, min_only=True, limit=limit)
    return found


def shortest_way(graph: Any, sources: Ints, targets: Ints) -> Ints:
    """Give the shortest way from any source to any target, both included.

    Returns
    -------
    (k,) int64, vertices in order; empty where no way leads there
    """
    from scipy.sparse.csgraph import dijkstra

    distance, before, _ = dijkstra(graph, indices=sources, min_only=True, return_predecessors=True)
    at = int(targets[np.argmin(distance[targets])])
    if not np.isfinite(distance[at]):
        return np.zeros(0, np.int64)
    return path_back(before, at)[::-1]


def path_back(before: Ints, at: int) -> Ints:
    """Follow predecessors (n,), negative for none, from a vertex back to its source, both included; (k,)."""
    path = [at]
    while before[path[-1]] >= 0:
        path.append(int(before[path[-1]]))
    return np.array(path, np.int64)
