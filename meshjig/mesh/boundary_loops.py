"""Walks along edges: the borders of a mesh in order, and paths from one branching to the next."""

import numpy as np

from meshjig.mesh.arrays import Ints
from meshjig.mesh.halfedges import border_halfedges, next_halfedge

__all__ = [
    "border_loop",
    "border_loops",
    "borders_by_length",
    "closed_loops",
    "longest_loop",
    "loops_by_length",
    "single_loop",
]


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
