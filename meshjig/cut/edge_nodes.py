"""The new vertices on the edges of the mesh: in order, apart from each other, shared over seams."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.snap import Graph
from meshjig.cut.trace import Crossings
from meshjig.cut.uv_mesh import UvMesh
from meshjig.mesh.arrays import starts
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["APART_MM", "EdgeNodes", "edge_nodes"]

APART_MM = 2e-4  # the least distance between vertices on an edge, where the edge is long enough
MEET_MM = 1e-3  # cuts from both sides of a seam meet when they end this close
TIE = 1e-11  # below this difference, the order on a side is decided with exact numbers
DIGITS = 140  # binary digits at which two fractions of 63-bit numbers differ, if they do


class EdgeNodes(NamedTuple):
    """New vertices on edges in space, sorted by edge and place."""

    edge: Ints  # (n,)
    along: Floats  # (n,), strictly between 0 and 1 from the edge's first end
    of_crossing: Ints  # (x,), the node of each crossing
    first: Ints  # (e,), the first node of each edge
    number: Ints  # (e,), how many nodes each edge has
    n_ties: int
    n_merged: int  # nodes that cuts from both sides of a seam came to share
    n_respaced: int  # edges on which nodes were moved apart


def edge_nodes(uv_mesh: UvMesh, graph: Graph, crossings: Crossings) -> EdgeNodes:
    """Make a node for each crossing, one for two where cuts meet over a seam.

    Both sides of a seam get all nodes of their common edge, so that the cut mesh conforms over it.
    """
    edge = uv_mesh.side_edge[crossings.side]
    along = np.where(uv_mesh.side_agrees[crossings.side], crossings.along_side, 1 - crossings.along_side)
    order = np.lexsort((along, edge))
    tied = np.zeros(len(order), bool)
    tied[1:] = (edge[order[1:]] == edge[order[:-1]]) & (along[order[1:]] - along[order[:-1]] < TIE)
    if tied.any():
        order = _exact_order(uv_mesh, graph, crossings, order, tied)
    E, T = edge[order], along[order]
    length = np.linalg.norm(uv_mesh.V[uv_mesh.E[E, 0]] - uv_mesh.V[uv_mesh.E[E, 1]], axis=1)
    merged = _meets_over_seam(crossings.side[order], E, T * length)
    node = np.cumsum(~merged) - 1
    of_crossing = np.empty(len(order), np.int64)
    of_crossing[order] = node
    edge, along, length = E[~merged], T[~merged], length[~merged]
    count = np.bincount(edge, minlength=len(uv_mesh.E))
    first = starts(count)
    along, n_respaced = _respaced(edge, along, length, np.arange(len(edge)) - first[edge], count[edge])
    return EdgeNodes(edge, along, of_crossing, first, count, int(tied.sum()), int(merged.sum()), n_respaced)


def _exact_order(uv_mesh: UvMesh, graph: Graph, crossings: Crossings, order: Ints, tied: Bools) -> Ints:
    """Sort runs of nearly equal crossings of one side by their exact place, symbolic shift included."""
    run = np.cumsum(~tied)
    member = tied.copy()
    member[:-1] |= tied[1:]
    slots = np.flatnonzero(member)
    x, run = order[slots], run[slots]
    side = crossings.side[x]
    ends = graph.points[graph.segments[crossings.segment[x]]]
    d = ends[:, 1] - ends[:, 0]
    sign = np.where(uv_mesh.side_agrees[side], 1, -1)
    keys = []
    for r, s, (p, q), (dx, dy), up in zip(
        run.tolist(), side.tolist(), crossings.turns[x].tolist(), d.tolist(), sign.tolist(), strict=True
    ):
        # place = p / (p - q); the shift (eps, eps^2) moves it by (eps dy - eps^2 dx) / (p - q)
        whole = p - q
        keys.append((r, s, *(up * ((n << DIGITS) // whole) for n in (p, dy, -dx))))
    ranked = np.array(sorted(range(len(x)), key=keys.__getitem__), np.int64)
    order = order.copy()
    order[slots[np.lexsort((slots, side, run))]] = x[ranked]
    return order


def _meets_over_seam(side: Ints, edge: Ints, place: Floats) -> Bools:
    """Mark sorted crossings that share the node before them: two sides of one edge, one place."""
    close = np.zeros(len(side), bool)
    close[1:] = (edge[1:] == edge[:-1]) & (side[1:] != side[:-1]) & (place[1:] - place[:-1] < MEET_MM)
    close[1:] &= ~close[:-1]
    return close


def _respaced(edge: Ints, along: Floats, length: Floats, rank: Ints, count: Ints) -> tuple[Floats, int]:
    """Move nodes apart, and away from the ends, on edges where that is needed."""
    step = np.minimum(APART_MM / np.maximum(length, 1e-30), 0.25 / (count + 1))
    crowded = (along < step * (rank + 1)) | (along > 1 - step * (count - rank))
    crowded[1:] |= (edge[1:] == edge[:-1]) & (np.diff(along) < step[1:])
    if not crowded.any():
        return along, 0
    edges = np.unique(edge[crowded])
    place = np.searchsorted(edges, edge)
    w = np.flatnonzero(edges[np.minimum(place, len(edges) - 1)] == edge)
    # measured from evenly spaced places, nodes need only keep their order
    shift, offset = rank[w] * step[w], 4.0 * place[w]
    slack = np.maximum.accumulate(along[w] - shift + offset) - offset
    along = along.copy()
    along[w] = np.clip(slack, step[w], 1 - count[w] * step[w]) + shift
    return along, len(edges)
