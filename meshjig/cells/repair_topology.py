"""Cells that are no discs: each is joined with a neighbour, and the union is cut in two another way."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.bisect import loops, poles_of, side_of
from meshjig.cells.march import Marched
from meshjig.cells.power import PowerField
from meshjig.cells.surface import Surface
from meshjig.mesh.halfedges import next_halfedge
from meshjig.mesh.measure import sums
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Pair", "cut_in_pairs", "pair_up", "split_up"]

_WHOLE = 0.9  # of a rim: one neighbour takes all of it
_SHIFT = 0.5  # of the distance between the lines: how far the cut may move to make halves even
_CONTACTS = 3  # neighbours that are tried in turn


class Pair(NamedTuple):
    """Two cells whose union is cut in two along a line between two poles."""

    first: int
    second: int
    poles: tuple[int, int]  # vertices; the first cell is around the first of them


class _Contact(NamedTuple):
    """A stretch of a cell's rim along a neighbour."""

    other: int
    share: float  # of the rim


def pair_up(s: Surface, cut: Marched, owner: Ints, bad: Bools, taken: Bools, turn: int) -> list[Pair]:
    """Find a partner for every cell that is no disc.

    A limb thinner than a cell carries cells that are rings, and a cap at its end. Two rings, or a ring
    and its cap, make two cells that lie along the limb. So does a ring at the foot of a limb with one of
    the cells around it.

    Parameters
    ----------
    s : Surface
    cut : Marched
    owner : (n,) int64, the cell of each vertex of the surface
    bad : (N,) bool, cells that are no discs
    taken : (N,) bool, cells that have a partner already
    turn : int, 0 at first; later ones ask the next best partner, or for another line

    Returns
    -------
    list of Pair, none of which share a cell; a cell without partner left has none
    """
    taken = taken.copy()
    out: list[Pair] = []
    for cell in np.flatnonzero(bad).tolist():
        if taken[cell]:
            continue
        contacts = [c for c in _contacts(cut, cell) if not taken[c.other]]
        contacts.sort(key=lambda c: -c.share * (2 if c.share > _WHOLE and bool(bad[c.other]) else 1))
        for contact in contacts[turn // 2 % _CONTACTS :][:1]:
            region = np.flatnonzero((owner == cell) | (owner == contact.other))
            poles = _even_poles(s, cut, owner, cell, region, turn % 2)
            if poles is not None:
                out.append(Pair(cell, contact.other, poles))
                taken[cell] = taken[contact.other] = True
    return out


def split_up(s: Surface, cut: Marched, owner: Ints, bad: Bools) -> list[Pair]:
    """Halve every cell that is no disc; the second halves are new cells.

    Parameters are those of pair_up.
    """
    out: list[Pair] = []
    for cell in np.flatnonzero(bad).tolist():
        poles = _even_poles(s, cut, owner, cell, np.flatnonzero(owner == cell), 0)
        if poles is not None:
            out.append(Pair(cell, len(bad) + len(out), poles))
    return out


def cut_in_pairs(
    s: Surface, field: PowerField, pairs: list[Pair], relative: Floats, spacing: float
) -> PowerField:
    """Change values so that each pair of cells is parted along a line between its poles.

    Where their union ends stays as it was.

    Parameters
    ----------
    s : Surface
    field : PowerField
    pairs : list of Pair; a later one may halve what an earlier one made
    relative : (N,) float64, areas of cells relative to one another
    spacing : float, mm

    Returns
    -------
    PowerField
    """
    seed, value = field.seed.copy(), field.value.copy()
    for pair in pairs:
        member = (seed == pair.first) | (seed == pair.second)
        near = np.flatnonzero(member.any(1))
        hit = member[near]
        both = np.where(hit, value[near], np.inf).min(1)
        inside = both <= value[near].min(1)
        side = np.zeros(len(near))
        region = near[inside]
        poles = _in_region(s, region, pair.poles)
        if poles[0] != poles[1]:
            share = relative[pair.first] / (relative[pair.first] + relative[pair.second])
            side[inside] = spacing * _parted(s, region, poles, share)
        first = hit.argmax(1)
        rest = np.where(hit, np.inf, value[near])  # where only one of the two is known, the farthest goes
        np.put_along_axis(rest, first[:, None], -np.inf, 1)
        last = rest.argmax(1)
        seed[near, first], seed[near, last] = pair.first, pair.second
        value[near, first], value[near, last] = both + np.maximum(-side, 0), both + np.maximum(side, 0)
    return PowerField(seed, value)


def _even_poles(
    s: Surface, cut: Marched, owner: Ints, cell: int, region: Ints, rank: int
) -> tuple[int, int] | None:
    """Choose poles on a cell so that a region is halved; of rank 1 another way than of rank 0."""
    poles = poles_of(s.V, np.flatnonzero(owner == cell), cut.mesh.F[cut.cell == cell], cut.mesh.V)
    if not len(poles):
        return None
    sides = [side_of(s, region, (p, q)) for p, q in poles.tolist()]
    area = s.area[region]
    uneven = [abs(float(area[side > 0].sum() / area.sum()) - 0.5) for side in sides]
    order = np.argsort(uneven, kind="stable")
    first, second = poles[order[min(rank * (len(order) // 2), len(order) - 1)]].tolist()
    return first, second


def _in_region(s: Surface, region: Ints, poles: tuple[int, int]) -> tuple[int, int]:
    """Give the vertices of a region that are nearest to poles."""
    if not len(region):
        return poles[0], poles[0]
    first, second = (int(region[((s.V[region] - s.V[p]) ** 2).sum(1).argmin()]) for p in poles)
    return first, second


def _parted(s: Surface, region: Ints, poles: tuple[int, int], share: float) -> Floats:
    """Give a function that is above 0 on a share of a region, around the first pole, (k,), mm."""
    side = side_of(s, region, poles)
    order = np.argsort(-side, kind="stable")
    run = np.cumsum(s.area[region][order])
    level = float(side[order[min(int(np.searchsorted(run, share * run[-1])), len(order) - 1)]])
    most = _SHIFT * float(np.abs(side).max())
    return side - np.clip(level, -most, most)


def _contacts(cut: Marched, cell: int) -> list[_Contact]:
    """List the neighbours of a cell along each of its rims."""
    twin = cut.mesh.edges.twin
    mine = np.flatnonzero(cut.cell == cell)[:, None] * 3 + np.arange(3)
    mine = mine.ravel()
    h = mine[(twin[mine] == mine) | (cut.cell[twin[mine] // 3] != cell)]
    other = np.where(twin[h] == h, -1, cut.cell[twin[h] // 3])
    start, end = cut.mesh.F.ravel()[h], cut.mesh.F.ravel()[next_halfedge(h)]
    length = np.linalg.norm(cut.mesh.V[start] - cut.mesh.V[end], axis=1)
    rim = loops(start, end)
    around = sums(rim, length, int(rim.max(initial=-1)) + 1)
    found, stretch = np.unique(np.stack([rim, other], 1), axis=0, return_inverse=True)
    along = sums(stretch.ravel(), length, len(found)) / np.maximum(around[found[:, 0]], 1e-300)
    return [
        _Contact(who, share)
        for (_, who), share in zip(found.tolist(), along.tolist(), strict=True)
        if who >= 0
    ]
