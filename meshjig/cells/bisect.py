"""Halving a stretch of surface along its length: lines that run along a limb however long it is."""

from typing import Any

import numpy as np

from meshjig.cells.surface import Surface
from meshjig.mesh.arrays import connected
from meshjig.mesh.halfedges import border_halfedges, next_halfedge
from meshjig.mesh.measure import unit
from meshjig.mesh.shortest_paths import distances, path_back
from meshjig.mesh.types import Floats, Ints

__all__ = ["loops", "poles_of", "side_of"]

_BAND = 0.3  # of the height of a ring: its middle
_DIRECTIONS = 8
_NEAREST = 0.05  # of the largest distance from a line: how near to it another line may come


def side_of(s: Surface, region: Ints, poles: tuple[int, int]) -> Floats:
    """Tell how much nearer vertices are to the first of two lines than to the second.

    Each line runs through a pole, from one end of the region to the other: from rim to rim, or from the
    rim to the tip of a cap. The second one keeps far from the first.

    Parameters
    ----------
    s : Surface
    region : (k,) int64, connected vertices, in ascending order
    poles : two of them

    Returns
    -------
    (k,) float64, mm
    """
    graph = s.graph[region][:, region]
    first, second = np.searchsorted(region, poles).tolist()
    ends = _ends(s, region, graph)
    away = _from(graph, _line(graph, first, ends))
    far = float(away.max())
    rows = np.repeat(np.arange(len(region)), np.diff(graph.indptr))
    closeness = far / np.maximum(np.minimum(away[rows], away[graph.indices]), _NEAREST * far + 1e-12)
    steered = graph.copy()
    steered.data = graph.data * closeness**2
    return _from(graph, _line(steered, second, ends)) - away


def _ends(s: Surface, region: Ints, graph: Any) -> list[Ints]:
    """Give the two longest rims of a region, or its rim and the vertex farthest from it."""
    inside = np.zeros(len(s.V), bool)
    inside[region] = True
    a, b = s.e.E.T
    out = np.concatenate([s.e.E[inside[a] != inside[b]].ravel(), s.e.E[s.e.n_faces == 1].ravel()])
    rim = np.flatnonzero(np.isin(region, out))
    if not len(rim):
        return [np.array([0]), np.array([_from(graph, np.array([0])).argmax()])]
    k, part = connected(len(rim), *graph[rim][:, rim].nonzero())
    rims = [rim[part == i] for i in np.argsort(-np.bincount(part), kind="stable")[:2]]
    return rims if k > 1 else [rim, np.array([_from(graph, rim).argmax()])]


def _line(graph: Any, pole: int, ends: list[Ints]) -> Ints:
    """Give the vertices on the shortest paths from a pole to both ends."""
    from scipy.sparse.csgraph import dijkstra

    far, before = dijkstra(graph, indices=pole, return_predecessors=True)
    paths = [path_back(before, int(end[far[end].argmin()])) for end in ends]
    return np.unique(np.concatenate([[pole], *paths]))


def _from(graph: Any, sources: Ints) -> Floats:
    """Give distances from sources; where there is no path, that of the farthest vertex."""
    far = distances(graph, sources)
    known = np.isfinite(far)
    return np.where(known, far, far[known].max(initial=0.0))


def poles_of(V: Floats, inside: Ints, F: Ints, W: Floats) -> Ints:
    """Find pairs of vertices that lie opposite each other on a cell.

    Parameters
    ----------
    V : (n, 3) float64, mm
    inside : (k,) int64, the vertices that the cell owns
    F : (m, 3) int64, the cell's faces, into W; where they make a ring, pairs lie midway between its rims
    W : (w, 3) float64, mm

    Returns
    -------
    (p, 2) int64, in different directions; empty where the cell owns too few vertices
    """
    rims = _rims(W, F)
    if len(inside) < 2:
        return np.zeros((0, 2), np.int64)
    x = V[inside] - V[inside].mean(0)
    axis = unit(rims[0] - rims[1]) if len(rims) == 2 else np.zeros(3)
    height = np.abs(x @ axis)
    band = height <= max(_BAND * float(height.max(initial=0.0)), 1e-12)
    x, inside = x[band], inside[band]
    if len(x) < 2:
        return np.zeros((0, 2), np.int64)
    flat = x - (x @ axis)[:, None] * axis
    plane = np.linalg.svd(flat - flat.mean(0), full_matrices=False)[2][:2]
    angle = np.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    direction = np.stack([np.cos(angle), np.sin(angle)], 1)[:, : len(plane)] @ plane
    reach = flat @ direction.T
    found = np.stack([inside[reach.argmin(0)], inside[reach.argmax(0)]], 1)
    return np.unique(found[found[:, 0] != found[:, 1]], axis=0)


def loops(start: Ints, end: Ints) -> Ints:
    """Number the loops that edges (k,) from start to end make, (k,)."""
    used, number = np.unique(np.stack([start, end]), return_inverse=True)
    a, b = number.reshape(2, -1)
    return connected(len(used), a, b)[1][a]


def _rims(V: Floats, F: Ints) -> list[Floats]:
    """Give the middle of every border loop of a mesh."""
    h = border_halfedges(F)
    start = F.ravel()[h]
    rim = loops(start, F.ravel()[next_halfedge(h)])
    return [V[start[rim == r]].mean(0) for r in range(int(rim.max(initial=-1)) + 1)]
