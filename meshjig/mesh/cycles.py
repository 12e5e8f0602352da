"""Things that follow each other, put in order: as cycles, or as chains with ends."""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Ints, starts

__all__ = ["Cycles", "chains", "cycles"]


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
