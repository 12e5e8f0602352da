"""The borders between pieces as directed lines of vertices, and fewer points on them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected, ragged, starts
from meshjig.mesh.chains import summed_along
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.solid.wall_edges import bent

__all__ = ["Chains", "border_chains", "edge_lines", "simplified"]


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
    return edge_lines(*_border_edges(F, piece_of_face))


def edge_lines(tail: Ints, head: Ints, pair: Ints) -> Chains:
    """Put directed edges together to lines.

    Parameters
    ----------
    tail, head : (e,) int64, vertices
    pair : (e, 2) int64, the pieces on both sides; a line ends where they change

    Returns
    -------
    Chains
    """
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


def simplified(X: Floats, Y: Floats, start: Ints, tolerance: float, bend: float) -> Bools:
    """Choose the points of some lines that walls ruled from X to Y can't do without.

    Parameters
    ----------
    X, Y : (n, 3) float64, mm, the walls' top and bottom
    start : (c + 1,) int64
        Where each line starts; the last entry is n. A line has two points at least.
    tolerance : float, mm
        How far the two lines of a wall may move.
    bend : float, mm
        How far a twisted quad's diagonal may be from the ruled wall.

    Returns
    -------
    (n,) bool; both ends of every line stay, and a third point of those that end where they start

    Notes
    -----
    The rule of Douglas and Peucker for both lines at once. All lines are split together, so the cost is a few
    passes over the points.

    References
    ----------
    Douglas and Peucker, "Algorithms for the reduction of the number of points required to represent a
    digitized line or its caricature", 1973.
    """
    keep = np.zeros(int(start[-1]), bool)
    low, high = start[:-1], start[1:] - 1
    keep[low] = keep[high] = True
    while True:
        open_ = high - low > 1
        low, high = low[open_], high[open_]
        if not len(low):
            return keep
        count = high - low - 1
        at, inner = starts(count), ragged(low + 1, count)
        i, j = np.repeat(low, count), np.repeat(high, count)
        off = np.maximum(_distances(X[inner], X[i], X[j]), _distances(Y[inner], Y[i], Y[j]))
        worst = np.maximum.reduceat(off, at)
        is_worst = np.flatnonzero(off == np.repeat(worst, count))
        middle = inner[is_worst[np.searchsorted(is_worst, at)]]
        turns = (worst <= tolerance) & bent(X, Y, low, high, bend)
        middle = np.where(turns, (low + high) // 2, middle)
        split = turns | (worst > tolerance)
        low, middle, high = low[split], middle[split], high[split]
        keep[middle] = True
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])


def _distances(P: Floats, A: Floats, B: Floats) -> Floats:
    """Give the distances of points to the segments from A to B, (n,), mm."""
    d, w = B - A, P - A
    along = np.einsum("ij,ij->i", w, d) / np.maximum(np.einsum("ij,ij->i", d, d), 1e-300)
    return np.asarray(np.linalg.norm(w - np.clip(along, 0, 1)[:, None] * d, axis=1))
