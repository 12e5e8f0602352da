"""The borders between pieces as directed lines of vertices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Ints, connected
from meshjig.mesh.boundary_loops import summed_along
from meshjig.mesh.halfedges import edges, next_halfedge

__all__ = ["Chains", "border_chains"]


class Chains(NamedTuple):
    """Border lines, one behind the other; a closed one names its first vertex again at its end."""

    vertex: Ints  # (n,), in the order of the lines
    start: Ints  # (c + 1,), where each line starts in vertex
    pair: Ints  # (c, 2), the pieces left and right of it, lower first


def border_chains(F: Ints, piece_of_face: Ints) -> Chains:
    """Walk along the edges between two pieces, from junction to junction.

    Parameters
    ----------
    F : (m, 3) int64, manifold
    piece_of_face : (m,) int64

    Returns
    -------
    Chains
        Every edge between two pieces, once. Lines end where other than two such edges meet; one without
        an end is closed.
    """
    tail, head, pair = _border_edges(F, piece_of_face)
    if not len(tail):
        return Chains(np.empty(0, np.int64), np.zeros(1, np.int64), np.empty((0, 2), np.int64))
    before = _edge_before(tail, head, pair)
    first, rank = _ranked(before)
    order = np.lexsort([rank, first])
    starts = np.flatnonzero(rank[order] == 0)
    ends = np.append(starts[1:], len(order))
    vertex = np.insert(tail[order], ends, head[order[ends - 1]])
    start = np.append(starts, len(order)) + np.arange(len(starts) + 1)
    return Chains(vertex, start, pair[order[starts]])


def _border_edges(F: Ints, piece_of_face: Ints) -> tuple[Ints, Ints, Ints]:
    """Give tail, head and pieces (left, right) of the edges between pieces, the lower piece left."""
    twin = edges(F).twin
    h = np.arange(len(twin))
    left, right = piece_of_face[h // 3], piece_of_face[twin // 3]
    h = np.flatnonzero((left < right) & (left >= 0))
    return F.ravel()[h], F.ravel()[next_halfedge(h)], np.stack([left[h], right[h]], 1)


def _edge_before(tail: Ints, head: Ints, pair: Ints) -> Ints:
    """Give the edge that leads into each edge, or -1 at junctions and ends; (e,)."""
    n = int(max(tail.max(), head.max())) + 1
    through = (np.bincount(tail, minlength=n) == 1) & (np.bincount(head, minlength=n) == 1)
    into = np.full(n, -1)
    into[head] = np.arange(len(head))
    before = np.where(through[tail], into[tail], -1)
    return np.where((pair[before] == pair).all(1), before, -1)


def _ranked(before: Ints) -> tuple[Ints, Ints]:
    """Give each edge the first edge of its line and its place in it; rings start at their least edge."""
    n = len(before)
    linked = np.flatnonzero(before >= 0)
    line = connected(n, linked, before[linked])[1]
    rooted = np.bincount(line, before < 0) > 0
    least = np.unique(line, return_index=True)[1]
    step = np.where(before < 0, np.arange(n), before)
    step[least[~rooted]] = least[~rooted]
    rank, first = summed_along(step, (step != np.arange(n)).astype(np.int64))
    return first, rank
