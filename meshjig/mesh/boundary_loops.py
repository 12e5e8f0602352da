"""Walks along edges: the borders of a mesh in order, and paths from one branching to the next."""

from typing import TypeVar

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import border_halfedges, next_halfedge

__all__ = [
    "border_loop",
    "border_loops",
    "borders_by_length",
    "chains",
    "closed_loops",
    "follow",
    "longest_loop",
    "loops_by_length",
    "runs",
    "single_loop",
    "summed_along",
]

Numbers = TypeVar("Numbers", Ints, Floats)


def border_loop(F: Ints) -> Ints:
    """Give the longest border loop of a mesh, its faces on the left.

    Parameters
    ----------
    F : (m, 3) int64, manifold; a vertex lies on one border at most

    Returns
    -------
    (b,) int64, vertices in order, the first not repeated; empty on a closed mesh
    """
    found = borders_by_length(F)
    return found[0] if found else np.zeros(0, np.int64)


def borders_by_length(F: Ints, border: Ints | None = None) -> list[Ints]:
    """List the border loops of a mesh, the longest first, faces on their left.

    Parameters
    ----------
    F : (m, 3) int64, manifold; a vertex lies on one border at most
    border : (b,) int64, the half-edges without a twin, where they are known

    Returns
    -------
    list of (b,) int64, vertices in order, the first not repeated
    """
    border = border_halfedges(F) if border is None else border
    return loops_by_length(F.ravel()[border], F.ravel()[next_halfedge(border)])


def loops_by_length(start: Ints, end: Ints) -> list[Ints]:
    """Follow edges from start (k,) to end (k,), and list the vertices of each loop, the longest first."""
    follows = dict(zip(start.tolist(), end.tolist(), strict=True))
    found = []
    while follows:
        at, after = follows.popitem()
        loop = [at]
        while after in follows:
            loop.append(after)
            after = follows.pop(after)
        found.append(np.array(loop, np.int64))
    return sorted(found, key=len, reverse=True)


def longest_loop(start: Ints, end: Ints) -> Ints:
    """Follow edges from start (k,) to end (k,), and give the vertices of the longest loop, (b,)."""
    return next(iter(loops_by_length(start, end)), np.zeros(0, np.int64))


def border_loops(F: Ints) -> list[Ints]:
    """List the vertices of every border loop of a mesh, its faces on the left; each begins anywhere."""
    rim = border_halfedges(F)
    start = F.ravel()[rim]
    return [start[loop] for loop in closed_loops(start, F.ravel()[next_halfedge(rim)])]


def closed_loops(start: Ints, end: Ints) -> list[Ints]:
    """Chain edges to closed loops.

    Parameters
    ----------
    start, end : (k,) int64, the vertices of each edge; as many edges end in a vertex as start there

    Returns
    -------
    list of (l,) int64
        The edges of each loop, from its first one on; loops come in the order of their first edges.
    """
    after = np.empty(len(start), np.int64)
    after[np.argsort(end, kind="stable")] = np.argsort(start, kind="stable")
    follows = after.tolist()
    seen = [False] * len(follows)
    loops = []
    for first in range(len(follows)):
        loop, at = [], first
        while not seen[at]:
            seen[at] = True
            loop.append(at)
            at = follows[at]
        if loop:
            loops.append(np.array(loop, np.int64))
    return loops


def single_loop(start: Ints, end: Ints) -> Ints | None:
    """Follow edges from start (k,) to end (k,); None where they make no single loop without pinches."""
    follows = dict(zip(start.tolist(), end.tolist(), strict=True))
    if len(follows) != len(start) or not follows:
        return None
    first = at = next(iter(follows))
    loop = [first]
    while (at := follows[at]) != first:
        loop.append(at)
        if len(loop) > len(start):
            return None
    return np.array(loop, np.int64) if len(loop) == len(start) else None


def runs(following: Ints, goes_on: Bools) -> list[Ints]:
    """Divide closed walks at their breaks.

    Parameters
    ----------
    following : (k,) int64, what comes after each thing
    goes_on : (k,) bool, whether there is no break after it

    Returns
    -------
    list of int64 arrays: from each break to the next; then the walks that have none
    """
    step, on = following.tolist(), goes_on.tolist()
    done = [False] * len(step)
    found = []
    for at in following[~goes_on].tolist() + list(range(len(step))):
        run = []
        while not done[at]:
            done[at] = True
            run.append(at)
            if not on[at]:
                break
            at = step[at]
        if run:
            found.append(np.array(run, np.int64))
    return found


def chains(E: Ints, stops: Ints) -> list[Ints]:
    """Follow edges from one vertex where they end, branch or are stopped to the next.

    Parameters
    ----------
    E : (k, 2) int64, vertices
    stops : (s,) int64, vertices where chains end though they would go on

    Returns
    -------
    list of int64 arrays, rows of E in order along the chain; a loop starts anywhere
    """
    vertex, number = np.unique(E, return_inverse=True)
    E = number.reshape(-1, 2)
    stops = np.flatnonzero(np.isin(vertex, stops))
    n = len(vertex)
    degree = np.bincount(E.ravel(), minlength=n)
    node = degree != 2
    node[stops] = True
    order = np.argsort(E.ravel(), kind="stable")
    start = np.append(0, np.cumsum(degree)).tolist()
    at_vertex, ends, is_node = (order // 2).tolist(), E.tolist(), node.tolist()
    done = [False] * len(ends)

    def walk(row: int, vertex: int) -> list[int]:
        chain = []
        while not done[row]:
            done[row] = True
            chain.append(row)
            vertex = ends[row][1] if ends[row][0] == vertex else ends[row][0]
            if is_node[vertex]:
                break
            first, second = at_vertex[start[vertex] : start[vertex + 1]]
            row = second if first == row else first
        return chain

    found = [
        walk(at_vertex[i], v) for v in np.flatnonzero(node).tolist() for i in range(start[v], start[v + 1])
    ]
    found += [walk(row, ends[row][0]) for row in range(len(ends))]
    return [np.array(chain, np.int64) for chain in found if chain]


def follow(after: Ints | list[int], first: int, seen: set[int]) -> list[int]:
    """Walk from one thing to what comes after it, until the end (-1) or what was seen; all are seen then."""
    walk, at = [], first
    while at >= 0 and at not in seen:
        seen.add(at)
        walk.append(at)
        at = int(after[at])
    return walk


def summed_along(after: Ints, values: Numbers) -> tuple[Numbers, Ints]:
    """Add up values (k,) from each thing to the last that comes after it, all chains at once.

    Parameters
    ----------
    after : (k,) int64, what comes after each thing; itself at the end of a chain, nothing in a ring
    values : (k,), 0 at the ends

    Returns
    -------
    total : (k,)
    last : (k,) int64
    """
    while (after[after] != after).any():  # twice as far each time
        values, after = values + values[after], after[after]
    return values, after
