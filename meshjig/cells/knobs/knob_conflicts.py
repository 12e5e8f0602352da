"""Which knobs would come too near each other."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.knobs.knob_borders import places_along
from meshjig.cells.knobs.knob_obstacles import Curves, Room
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["clashes"]

_ROOT = 0.62  # radius of the disc behind a neck, in half widths of the head


class _Discs(NamedTuple):
    """Sets of discs, each in the plane of a cell."""

    cell: Ints  # (c,)
    discs: Floats  # (c, d, 3), x, y, radius

    def bounds(self) -> Floats:
        """Give a disc around each set, (c, 3)."""
        middle = self.discs[..., :2].mean(1)
        away = self.discs[..., :2] - middle[:, None]
        reach = (np.hypot(away[..., 0], away[..., 1]) + self.discs[..., 2]).max(1)
        return np.concatenate([middle, reach[:, None]], 1)


def clashes(room: Room, c: Curves) -> Ints:
    """List pairs of curves on different borders that are too near each other, (k, 2).

    Two knobs in one cell keep their distance. A knob in a cell also keeps it from the root of one
    that leaves the cell: that would hang on a thread.
    """
    b = room.borders
    shape = room.shapes.discs[c.shape]
    inside = np.concatenate([c.drawn(shape[..., :2]), shape[..., 2:] * c.radius[:, None, None]], -1)
    knobs = _Discs(b.cell[c.side], inside)
    roots = _Discs(b.cell[b.opposite(c.side)], _roots(room, c))
    border = b.border[c.side]
    pairs = []
    for other in (knobs, roots):
        i, j = _equal(knobs.cell, other.cell)
        apart = (border[i] < border[j]) if other is knobs else (border[i] != border[j])
        i, j = i[apart], j[apart]
        close = _near(knobs.bounds(), other.bounds(), i, j, room.clear)
        i, j = i[close], j[close]
        near = np.zeros(len(i), bool)
        for p in range(knobs.discs.shape[1]):
            for q in range(other.discs.shape[1]):
                near |= _near(knobs.discs[:, p], other.discs[:, q], i, j, room.clear)
        pairs.append(np.sort(np.stack([i[near], j[near]], 1), axis=1))
    return np.unique(np.concatenate(pairs), axis=0)


def _roots(room: Room, c: Curves) -> Floats:
    """Give discs where curves leave the cell that they belong to, (c, 1, 3)."""
    b = room.borders
    mm, start, other = b.mm(), b.along[b.span[:, 0]], b.opposite(c.side)
    at = (c.place - start[c.side]) / mm[c.side]
    middle = places_along(b, start[other] + (1 - at) * mm[other])
    return np.concatenate([middle, _ROOT * c.radius[:, None]], 1)[:, None]


def _near(a: Floats, b: Floats, i: Ints, j: Ints, gap: float) -> Bools:
    """Tell which pairs of discs a[i] and b[j] are less than a gap apart."""
    d = a[i] - b[j]
    return d[:, 0] ** 2 + d[:, 1] ** 2 < (a[i, 2] + b[j, 2] + gap) ** 2


def _equal(a: Ints, b: Ints) -> tuple[Ints, Ints]:
    """List all pairs (i, j) with a[i] equal to b[j]."""
    order = np.argsort(b, kind="stable")
    first = np.searchsorted(b[order], a)
    count = np.searchsorted(b[order], a, side="right") - first
    i = np.repeat(np.arange(len(a)), count)
    offset = np.arange(len(i)) - np.repeat(np.cumsum(count) - count, count)
    return i, order[first[i] + offset]
