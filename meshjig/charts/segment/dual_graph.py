"""A mesh seen face by face, and compact patches grown over it."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, edge_lengths, unit

__all__ = ["DualGraph", "dual_graph", "patches"]

_CREASE_COST = 12.0  # how much farther it is to walk over a fold than over a flat edge


class DualGraph(NamedTuple):
    """The dual graph; rows of the first group are inner edges, rows of the second are faces."""

    first: Ints  # (e,), face on one side
    second: Ints  # (e,), face on the other
    ends: Ints  # (e, 2), vertices of the edge
    length: Floats  # (e,), mm
    span: Floats  # (e,), mm from centre to centre over the middle of the edge
    bend: Floats  # (e,), cosine between the normals
    halfedge: Ints  # (e,), of the edge, in first
    twin: Ints  # (e,), of the edge, in second

    centre: Floats  # (m, 3)
    normal: Floats  # (m, 3)
    area: Floats  # (m,)

    def adjacency(self, weight: Floats) -> Any:
        """The faces' symmetric adjacency matrix with a weight an edge."""
        from scipy.sparse import csr_matrix

        rows, cols = np.append(self.first, self.second), np.append(self.second, self.first)
        m = len(self.area)
        return csr_matrix((np.append(weight, weight), (rows, cols)), shape=(m, m))


def dual_graph(V: Floats, F: Ints) -> DualGraph:
    """Build the dual graph of a mesh.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold

    Returns
    -------
    DualGraph
    """
    e = edges(F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    first, second = h // 3, e.twin[h] // 3
    ends = e.E[e.edge_of_halfedge[h]]
    normal = area_vectors(V, F)
    area = np.linalg.norm(normal, axis=1) / 2
    normal = unit(normal)
    centre, middle = V[F].mean(1), V[ends].mean(1)
    length = edge_lengths(V, ends)
    span = np.linalg.norm(centre[first] - middle, axis=1) + np.linalg.norm(centre[second] - middle, axis=1)
    bend = np.clip(np.einsum("ij,ij->i", normal[first], normal[second]), -1, 1)
    return DualGraph(first, second, ends, length, span, bend, h, e.twin[h], centre, normal, area)


def patches(dual: DualGraph, n_patches: int, seed: int = 0, rounds: int = 8) -> Ints:
    """Grow patches from seeds spread over the mesh, and centre the seeds again and again.

    Parameters
    ----------
    dual : DualGraph, connected
    n_patches : int
    seed : int
    rounds : int

    Returns
    -------
    patch_of_face : (m,) int64, 0 to n_patches - 1; patches are connected
    """
    graph = dual.adjacency(dual.span * (1 + _CREASE_COST * (1 - dual.bend)) + 1e-9)
    seeds = _far_seeds(graph, min(n_patches, len(dual.area)), seed)
    for _ in range(rounds - 1):
        seeds = _central_faces(dual, _nearest_seed(graph, seeds), len(seeds))
    label = _nearest_seed(graph, seeds)
    return np.unique(label, return_inverse=True)[1].astype(np.int64)


def _far_seeds(graph: Any, n: int, seed: int) -> Ints:
    from scipy.sparse.csgraph import dijkstra

    start = int(np.random.default_rng(seed).integers(graph.shape[0]))
    seeds = [int(np.argmax(dijkstra(graph, indices=start)))]
    reach = dijkstra(graph, indices=seeds[0])
    while len(seeds) < n:
        far = int(np.argmax(reach))
        seeds.append(far)
        reach = np.minimum(reach, dijkstra(graph, indices=far, limit=1.01 * reach[far]))
    return np.array(seeds, np.int64)


def _nearest_seed(graph: Any, seeds: Ints) -> Ints:
    from scipy.sparse.csgraph import dijkstra

    number = np.full(graph.shape[0], 0, np.int64)
    number[seeds] = np.arange(len(seeds))
    _, _, source = dijkstra(graph, indices=seeds, min_only=True, return_predecessors=True)
    return number[np.maximum(source, 0)]


def _central_faces(dual: DualGraph, label: Ints, n: int) -> Ints:
    """Give each patch's face that is nearest to its mean place and mean normal."""
    area = np.bincount(label, dual.area, n)
    mean = _sums(label, dual.centre * dual.area[:, None], n) / np.maximum(area, 1e-300)[:, None]
    normal = _sums(label, dual.normal * dual.area[:, None], n)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    cost = ((dual.centre - mean[label]) ** 2).sum(1) / np.maximum(area, 1e-300)[label]
    cost += 0.5 * (1 - np.einsum("ij,ij->i", dual.normal, normal[label]))
    order = np.lexsort([cost, label])
    _, start = np.unique(label[order], return_index=True)
    return order[start]


def _sums(label: Ints, X: Floats, n: int) -> Floats:
    return np.stack([np.bincount(label, x, n) for x in X.T], 1)
