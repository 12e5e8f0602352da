"""From values of power cells to cells that are discs, cut along their borders."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.discs import DISC, RING, shapes
from meshjig.cells.march import Marched, march
from meshjig.cells.power import PowerField
from meshjig.cells.repair_topology import Pair, cut_in_pairs, pair_up, split_up
from meshjig.cells.surface import Surface
from meshjig.mesh.arrays import connected
from meshjig.mesh.measure import sums
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Extracted", "connect_labels", "extract"]

_WITH_PARTNERS = 6  # rounds
_ROUNDS = 14
_STRAY_ROUNDS = 8


class Extracted(NamedTuple):
    """A surface cut into cells."""

    cut: Marched
    pairs: list[Pair]
    good: Bools  # (N,), the cell is a disc

    @property
    def n(self) -> int:
        """Count the cells."""
        return len(self.good)


def extract(
    s: Surface, field: PowerField, n: int, pairs: list[Pair], relative: Floats, spacing: float
) -> Extracted:
    """Cut a surface into cells; those that are no discs are joined with others and cut another way.

    Where that does not help, a cell is halved, again and again: then there are more than n.

    Parameters
    ----------
    s : Surface
    field : PowerField, of n power cells
    n : int
    pairs : list of Pair, known from an earlier pass
    relative : (N,) float64, areas of cells relative to one another, n of them or more
    spacing : float, mm

    Returns
    -------
    Extracted
    """
    pairs = list(pairs)
    for turn in range(_ROUNDS):
        count = n + sum(pair.second >= n for pair in pairs)
        relative = np.append(relative, np.ones(max(count - len(relative), 0)))
        parted = cut_in_pairs(s, field, pairs, relative, spacing)
        owner = connect_labels(s.e.E, parted.owner, s.area)
        cut = march(s, owner, parted)
        shape = shapes(cut.mesh, cut.cell, count)
        good = shape == DISC
        if good.all():
            break
        rings = shape == RING
        if turn < _WITH_PARTNERS and rings.any() and count == n:
            pairs = [pair for pair in pairs if good[pair.first] and good[pair.second]]
            pairs += pair_up(s, cut, owner, rings, _taken(pairs, count), turn)
        else:
            pairs += split_up(s, cut, owner, ~good)
    return Extracted(cut, pairs, good)


def _taken(pairs: list[Pair], n: int) -> Bools:
    out = np.zeros(n, bool)
    out[[cell for pair in pairs for cell in (pair.first, pair.second)]] = True
    return out


def connect_labels(E: Ints, owner: Ints, area: Floats) -> Ints:
    """Keep the largest connected part of every label; the rest takes the labels beside it.

    Parameters
    ----------
    E : (e, 2) int64, edges
    owner : (n,) int64, labels 0..N-1
    area : (n,) float64, of each vertex

    Returns
    -------
    (n,) int64
    """
    owner = owner.copy()
    for _ in range(_STRAY_ROUNDS):
        a, b = E[owner[E[:, 0]] == owner[E[:, 1]]].T
        k, part = connected(len(owner), a, b)
        size, label = sums(part, area, k), np.empty(k, np.int64)
        label[part] = owner
        largest = np.empty(int(owner.max()) + 1, np.int64)
        by_size = np.argsort(size, kind="stable")
        largest[label[by_size]] = by_size
        stray = largest[owner] != part
        if not stray.any():
            break
        ends = np.concatenate([E, E[:, ::-1]])
        beside = ends[stray[ends[:, 0]] & ~stray[ends[:, 1]]]
        if not len(beside):
            break
        owner[beside[:, 0]] = owner[beside[:, 1]]
    return owner
