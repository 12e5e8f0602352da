"""Borders, in order; and how to walk from one thing to the next."""

from typing import TypeVar

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import border_halfedges, next_halfedge

__all__ = ["border_loop", "border_loops", "closed_loops", "follow", "longest_loop", "summed_along"]

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
    rim = border_halfedges(F)
    return longest_loop(F.ravel()[rim], F.ravel()[next_halfedge(rim)])


def longest_loop(start: Ints, end: Ints) -> Ints:
    """Follow edges from start (k,) to end (k,), and give the vertices of the longest loop, (b,)."""
    follows = dict(zip(start.tolist(), end.tolist(), strict=True))
    longest: list[int] = []
    while follows:
        at, after = follows.popitem()
        loop = [at]
        while after in follows:
            loop.append(after)
            after = follows.pop(after)
        longest = max(longest, loop, key=len)
    return np.array(longest, np.int64)


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
