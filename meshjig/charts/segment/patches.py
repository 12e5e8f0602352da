"""Cover a mesh with many compact patches, the raw material of charts."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.dual_graph import Dual

__all__ = ["patches"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_CREASE_COST = 12.0  # how much farther it is to walk over a fold than over a flat edge


def patches(dual: Dual, n_patches: int, seed: int = 0, rounds: int = 8) -> Ints:
    """Grow patches from seeds spread over the mesh, and centre the seeds again and again.

    Parameters
    ----------
    dual : Dual, connected
    n_patches : int
    seed : int
    rounds : int

    Returns
    -------
    patch_of_face : (m,) int64, 0 to n_patches - 1; patches hang together
    """
    graph = dual.graph(dual.span * (1 + _CREASE_COST * (1 - dual.bend)) + 1e-9)
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


def _central_faces(dual: Dual, label: Ints, n: int) -> Ints:
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
