"""Close half-edges to cycles."""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.types import Ints

__all__ = ["Cycles", "cycles"]


class Cycles(NamedTuple):
    """Cycles of half-edges, one after the other."""

    members: Ints  # (h,), half-edges in the order of the cycles
    first: Ints  # (c,), where each cycle starts in members
    size: Ints  # (c,)
    of_half_edge: Ints  # (h,), the cycle of each half-edge


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
    first = np.cumsum(size) - size
    members = np.empty(n, np.int64)
    heads = np.flatnonzero(leads)
    here, place = heads, first.copy()
    while len(here):
        members[place] = here
        here = follows[here]
        going = leader[here] != here
        here, place = here[going], place[going] + 1
    return Cycles(members, first, size, number)
