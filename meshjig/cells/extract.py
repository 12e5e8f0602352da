"""From values of power cells to cells that are discs, cut along their borders."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.connect_labels import whole
from meshjig.cells.discs import DISC, RING, shapes
from meshjig.cells.march import Marched, march
from meshjig.cells.power import Field
from meshjig.cells.repair_topology import Pair, cut_in_pairs, pair_up, split_up
from meshjig.cells.surface import Surface
from meshjig.mesh.types import Bools, Floats

__all__ = ["Parted", "part"]

_WITH_PARTNERS = 6  # rounds
_ROUNDS = 14


class Parted(NamedTuple):
    """A surface cut into cells."""

    cut: Marched
    pairs: list[Pair]
    good: Bools  # (N,), the cell is a disc

    @property
    def n(self) -> int:
        """Count the cells."""
        return len(self.good)


def part(s: Surface, field: Field, n: int, pairs: list[Pair], relative: Floats, spacing: float) -> Parted:
    """Cut a surface into cells; those that are no discs are joined with others and cut another way.

    Where that does not help, a cell is halved, again and again: then there are more than n.

    Parameters
    ----------
    s : Surface
    field : Field, of n power cells
    n : int
    pairs : list of Pair, known from an earlier pass
    relative : (N,) float64, areas of cells relative to one another, n of them or more
    spacing : float, mm

    Returns
    -------
    Parted
    """
    pairs = list(pairs)
    for turn in range(_ROUNDS):
        count = n + sum(pair.second >= n for pair in pairs)
        relative = np.append(relative, np.ones(max(count - len(relative), 0)))
        parted = cut_in_pairs(s, field, pairs, relative, spacing)
        owner = whole(s.e.E, parted.owner, s.area)
        cut = march(s, owner, parted)
        shape = shapes(cut.F, cut.cell, count, cut.e)
        good = shape == DISC
        if good.all():
            break
        rings = shape == RING
        if turn < _WITH_PARTNERS and rings.any() and count == n:
            pairs = [pair for pair in pairs if good[pair.first] and good[pair.second]]
            pairs += pair_up(s, cut, owner, rings, _taken(pairs, count), turn)
        else:
            pairs += split_up(s, cut, owner, ~good)
    return Parted(cut, pairs, good)


def _taken(pairs: list[Pair], n: int) -> Bools:
    out = np.zeros(n, bool)
    out[[cell for pair in pairs for cell in (pair.first, pair.second)]] = True
    return out
