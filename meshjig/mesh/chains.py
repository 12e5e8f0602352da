"""Things that follow each other, put in order: as cycles, or as chains with ends."""

from typing import NamedTuple, TypeVar

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, starts

__all__ = ["Cycles", "chains", "cycles", "edge_chains", "follow", "runs", "summed_along"]

Numbers = TypeVar("Numbers", Ints, Floats)


class Cycles(NamedTuple):
    """Cycles of things, one after the other."""

    members: Ints  # (h,), things in the order of the cycles
    first: Ints  # (c,), where each cycle starts in members
    size: Ints  # (c,)
    of_member: Ints  # (h,), the cycle of each thing


def cycles(follows: Ints) -> Cycles:
    """List the cycles of a permutation, each from its lowest member, by pointer doubling."""
    n = len(follows)
    leader = np.minimum(np.arange(n), follows)
    jump = follows[follows]
    while True:
        lower = np.minimum(leader, leader[jump])
        if np.array_equal(lower, leader):
            break
        leader, jump = lower, jump[jump]
    leads = leader == np.arange(n)
    number = (np.cumsum(leads) - 1)[leader]
    size = np.bincount(number)
    first = starts(size)
    members = np.empty(n, np.int64)
    heads = np.flatnonzero(leads)
    here, place = heads, first.copy()
    while len(here):
        members[place] = here
        here = follows[here]
        going = leader[here] != here
        here, place = here[going], place[going] + 1
    return Cycles(members, first, size, number)


def chains(after: Ints) -> tuple[Ints, Ints]:
    """Put things in order that each have one after them, or none.

    Parameters
    ----------
    after : (k,) int64, the thing after each, -1 for none

    Returns
    -------
    order : (k,) int64
        Chains first, each from its head, the lowest head first; then cycles, each from its lowest member. A
        chain ends where another one has been.
    first : (c,) int64, where each of them starts in the order
    """
    is_head = np.ones(len(after), bool)
    is_head[after[after >= 0]] = False
    following, left = after.tolist(), [True] * len(after)
    order: list[int] = []
    first = []
    for at in [*np.flatnonzero(is_head).tolist(), *range(len(after))]:
        if left[at]:
            first.append(len(order))
        while at >= 0 and left[at]:
            left[at] = False
            order.append(at)
            at = following[at]
    return np.array(order, np.int64), np.array(first, np.int64)


def edge_chains(E: Ints, stops: Ints) -> list[Ints]:
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
    after : (k,) int64, what comes after each thing; itself at the end of a chain
    values : (k,), 0 at the ends

    Returns
    -------
    total : (k,); of no meaning where things follow each other in a ring that has no end
    last : (k,) int64
    """
    for _ in range(len(after).bit_length()):  # twice as far each time
        if (after[after] == after).all():
            break
        values, after = values + values[after], after[after]
    return values, after
