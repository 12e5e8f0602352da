"""Which of the knobs that fit are made: one a border, none too near another, areas even."""

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_matrix

from meshjig.mesh.types import Floats, Ints

__all__ = ["Choices", "choose"]

_CONFLICT = 100.0  # costs more than leaving a border plain
_BALANCE = 40.0  # times the square of what a cell's area is off, in mean areas
_SWEEPS = 160
_COLDEST = 8  # sweeps without chance, at the end
_HOT = 1.0  # how much chance weighs at first, in units of cost


class Choices(NamedTuple):
    """What borders can be made as: a knob or a wave at some place, or nothing."""

    border: Ints  # (c,)
    cost: Floats  # (c,)
    gives: Ints  # (c,), the cell that loses area
    takes: Ints  # (c,), the cell that gains it
    area: Floats  # (c,), mm2

    def take(self, which: Ints) -> "Choices":
        """Give some of them."""
        border, cost, gives, takes, area = self
        return Choices(border[which], cost[which], gives[which], takes[which], area[which])


def choose(
    choices: Choices,
    conflicts: Ints,
    cell_area: Floats,
    n_borders: int,
    rng: np.random.Generator,
    start: Ints | None = None,
) -> Ints:
    """Choose one for every border, by simulated annealing.

    They shall be good, none in conflict with another, and cells come out equal in area. Borders without a
    cell in common don't mind each other, so all those of one colour are chosen at once.

    Parameters
    ----------
    choices : Choices, at least one a border
    conflicts : (k, 2) int64, choices that don't go together; their borders have a cell in common
    cell_area : (n,) float64, mm2
    n_borders : int
    rng : Generator
    start : (n_borders,) int64, optional
        An earlier choice, into choices, which is only mended where something better is next to it.

    Returns
    -------
    chosen : (n_borders,) int64, into choices
    """
    colour = _colours(choices, n_borders, len(cell_area))[choices.border]
    order = np.lexsort([choices.border, colour])
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    o = choices.take(order)
    n = len(order)
    rows, cols = place[conflicts].T
    graph = csr_matrix((np.ones(2 * len(rows)), (np.r_[rows, cols], np.r_[cols, rows])), shape=(n, n))
    starts = np.searchsorted(colour[order], np.arange(int(colour.max(initial=-1)) + 2))
    classes = [_Class(o, graph, a, b) for a, b in pairwise(starts.tolist()) if b > a]

    mean = float(cell_area.mean())
    now = _State(np.full(n_borders, -1), np.zeros(n), cell_area / mean - 1, o.area / mean)
    if start is not None:
        now.chosen[:] = place[start]
        now.move(o, now.chosen)
    for sweep in range(0 if start is None else _SWEEPS - _COLDEST, _SWEEPS):
        heat = _HOT * max(0.0, 1 - sweep / (_SWEEPS - _COLDEST)) ** 2
        for group in classes:
            before = now.chosen[group.borders]
            now.move(o, before[before >= 0], back=True)
            now.chosen[group.borders] = group.best(now, heat, rng)
            now.move(o, now.chosen[group.borders])
    return order[now.chosen]


class _State(NamedTuple):
    """What is chosen so far."""

    chosen: Ints  # (b,), -1 before the first choice
    made: Floats  # (c,), 1 for what is chosen
    excess: Floats  # (n,), area of each cell beyond the mean, in means
    area: Floats  # (c,), that each choice moves, in means

    def move(self, o: Choices, which: Ints, back: bool = False) -> None:
        self.made[which] = 0 if back else 1
        area = -self.area[which] if back else self.area[which]
        np.add.at(self.excess, o.gives[which], -area)
        np.add.at(self.excess, o.takes[which], area)


class _Class:
    """Borders that can be chosen at once, and their choices, a to b."""

    def __init__(self, o: Choices, graph: Any, a: int, b: int) -> None:
        self.cost, self.gives, self.takes = o.cost[a:b], o.gives[a:b], o.takes[a:b]
        self.rows = slice(a, b)
        self.conflicts = graph[a:b]
        self.borders, self.starts = np.unique(o.border[a:b], return_index=True)
        self.count = np.diff(np.append(self.starts, b - a))

    def best(self, now: _State, heat: float, rng: np.random.Generator) -> Ints:
        """Choose one for each border, the others being made."""
        area = now.area[self.rows]
        uneven = 2 * area * (now.excess[self.takes] - now.excess[self.gives] + area)
        cost = self.cost + _CONFLICT * (self.conflicts @ now.made) + _BALANCE * uneven
        if heat > 0:
            cost = cost + heat * rng.gumbel(size=len(cost))
        least = np.repeat(np.minimum.reduceat(cost, self.starts), self.count)
        hits = np.flatnonzero(cost == least)
        border = np.searchsorted(self.starts, hits, side="right") - 1
        return self.rows.start + hits[np.unique(border, return_index=True)[1]]


def _colours(o: Choices, n_borders: int, n_cells: int) -> Ints:
    """Colour borders so that those with a cell in common differ, (b,)."""
    first = np.unique(o.border, return_index=True)[1]
    cells = np.stack([o.gives[first], o.takes[first]], 1).tolist()
    taken = [0] * n_cells
    colour = np.empty(n_borders, np.int64)
    for border, (a, b) in enumerate(cells):
        free = ~(taken[a] | taken[b])
        bit = free & -free
        taken[a] |= bit
        taken[b] |= bit
        colour[border] = bit.bit_length() - 1
    return colour
