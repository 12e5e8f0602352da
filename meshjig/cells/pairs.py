"""Cells that are no discs: each is joined with a neighbour, and the union is cut in two another way."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.march import Marched
from meshjig.cells.power import Field
from meshjig.cells.surface import Surface
from meshjig.measure import unit
from meshjig.topology import border_halfedges, next_halfedge
from meshjig.types import Bools, Floats, Ints

__all__ = ["Pair", "cut_in_pairs", "pair_up", "split_up"]

_WHOLE = 0.9  # of a rim: one neighbour takes all of it
_BAND = 0.3  # of the height of a ring: its middle
_ASIDE = 0.15  # of the radius of a ring: a partner off its axis by more has a side
_SHIFTS = (4.0, 0.5)  # a line that is moved far may leave the limb
_REACH = 6.0  # spacings: farther from a pole than that, a cell can't reach


class Pair(NamedTuple):
    """Two cells whose union is cut in two halfway between two poles."""

    first: int
    second: int
    poles: tuple[int, int]  # vertices; the first cell is around the first of them
    shift: float  # how far the line between them may move for equal areas, of their squared distance


class _Contact(NamedTuple):
    """A stretch of a cell's rim along a neighbour."""

    other: int
    share: float  # of the rim
    middle: Floats  # (3,), mm


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
    turn : int, 0 at first; later ones ask the next best partner

    Returns
    -------
    list of Pair, none of which share a cell; a cell without partner left has none
    """
    taken = taken.copy()
    out: list[Pair] = []
    for cell in np.flatnonzero(bad):
        if taken[cell]:
            continue
        contacts = [c for c in _contacts(cut, int(cell)) if not taken[c.other]]
        contacts.sort(key=lambda c: -c.share * (2 if c.share > _WHOLE and bool(bad[c.other]) else 1))
        if not contacts:
            continue
        chosen = contacts[min(turn // 2 % 2, len(contacts) - 1)]
        poles = _poles(s, cut, owner, int(cell), chosen.middle, turn % 2 == 1)
        if poles is None:
            continue
        out.append(Pair(int(cell), chosen.other, poles, _SHIFTS[turn // 4 % 2]))
        taken[cell] = taken[chosen.other] = True
    return out


def split_up(s: Surface, cut: Marched, owner: Ints, bad: Bools) -> list[Pair]:
    """Halve every cell that is no disc; the second halves are new cells.

    Parameters are those of pair_up.
    """
    out: list[Pair] = []
    n = len(bad)
    for cell in np.flatnonzero(bad):
        poles = _poles(s, cut, owner, int(cell), None, False)
        if poles is not None:
            out.append(Pair(int(cell), n + len(out), poles, _SHIFTS[1]))
    return out


def cut_in_pairs(s: Surface, field: Field, pairs: list[Pair], relative: Floats, spacing: float) -> Field:
    """Change values so that each pair of cells is parted halfway between its poles, by area.

    Where their union ends stays as it was.

    Parameters
    ----------
    s : Surface
    field : Field
    pairs : list of Pair; a later one may halve what an earlier one made
    relative : (N,) float64, areas of cells relative to one another
    spacing : float, mm

    Returns
    -------
    Field
    """
    from scipy.sparse.csgraph import dijkstra

    seed, value = field.seed.copy(), field.value.copy()
    limit = _REACH * spacing
    for pair in pairs:
        far = dijkstra(s.graph, indices=list(pair.poles), limit=limit)
        side = np.minimum(far[0], limit) ** 2 - np.minimum(far[1], limit) ** 2
        one, two = (seed == cell for cell in pair[:2])
        near = np.flatnonzero(one.any(1) | two.any(1))
        both = np.where((one | two)[near], value[near], np.inf).min(1)
        inside = near[both <= value[near].min(1)]
        order = inside[np.argsort(side[inside], kind="stable")]
        run = np.cumsum(s.area[order])
        share = relative[pair.first] / (relative[pair.first] + relative[pair.second])
        half = np.searchsorted(run, share * run[-1]) if len(run) else 0
        level = side[order[min(half, len(order) - 1)]] if len(order) else 0.0
        most = pair.shift * min(float(far[0, pair.poles[1]]), limit) ** 2
        level = float(np.clip(level, -most, most))
        hit = (one | two)[near]
        first = hit.argmax(1)
        rest = np.where(hit, np.inf, value[near])  # where only one of the two is known, the farthest goes
        np.put_along_axis(rest, first[:, None], -np.inf, 1)
        last = rest.argmax(1)
        seed[near, first], seed[near, last] = pair.first, pair.second
        value[near, first] = both + np.maximum(side[near] - level, 0)
        value[near, last] = both + np.maximum(level - side[near], 0)
    return Field(seed, value)


def _contacts(cut: Marched, cell: int) -> list[_Contact]:
    """List the neighbours of a cell along each of its rims."""
    twin = cut.e.twin
    mine = np.flatnonzero(cut.cell[np.arange(len(twin)) // 3] == cell)
    h = mine[(twin[mine] == mine) | (cut.cell[twin[mine] // 3] != cell)]
    other = np.where(twin[h] == h, -1, cut.cell[twin[h] // 3])
    start, end = cut.F.ravel()[h], cut.F.ravel()[next_halfedge(h)]
    length, middle = np.linalg.norm(cut.V[start] - cut.V[end], axis=1), (cut.V[start] + cut.V[end]) / 2
    rim = _loops(start, end)
    out = []
    for r, who in np.unique(np.stack([rim, other], 1), axis=0).tolist():
        along = (rim == r) & (other == who)
        if who >= 0:
            share = float(length[along].sum() / max(length[rim == r].sum(), 1e-300))
            out.append(
                _Contact(who, share, np.average(middle[along], axis=0, weights=length[along] + 1e-300))
            )
    return out


def _poles(
    s: Surface, cut: Marched, owner: Ints, cell: int, toward: Floats | None, turned: bool
) -> tuple[int, int] | None:
    """Choose two vertices opposite each other on a limb, a quarter of a turn from where a partner is.

    Then the line between them runs through the partner, and along the limb though it is bent.
    """
    inside = np.flatnonzero(owner == cell)
    if len(inside) < 2:
        return None
    rims = _rims(cut.V, cut.F[cut.cell == cell])
    axis = unit(rims[0] - rims[1]) if len(rims) == 2 else np.zeros(3)
    x = s.V[inside] - s.V[inside].mean(0)
    height = np.abs(x @ axis)
    band = height <= max(_BAND * float(height.max()), 1e-12)
    if band.sum() > 1:
        inside, x = inside[band], x[band]
    flat = x - (x @ axis)[:, None] * axis
    flat -= flat.mean(0)
    along = np.linalg.svd(flat, full_matrices=False)[2][0]
    if toward is not None and axis.any():
        out = toward - s.V[inside].mean(0)
        out = out - (out @ axis) * axis
        if np.linalg.norm(out) > _ASIDE * np.abs(flat).max():
            along = np.cross(axis, unit(out))
    if turned:
        along = np.cross(axis, along)
    reach = flat @ along
    first, second = int(inside[reach.argmin()]), int(inside[reach.argmax()])
    return (first, second) if first != second else None


def _rims(V: Floats, F: Ints) -> list[Floats]:
    """Give the middle of every border loop of a mesh."""
    h = border_halfedges(F)
    start = F.ravel()[h]
    rim = _loops(start, F.ravel()[next_halfedge(h)])
    return [V[start[rim == r]].mean(0) for r in range(int(rim.max(initial=-1)) + 1)]


def _loops(start: Ints, end: Ints) -> Ints:
    """Number the loops that edges make, (k,)."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    used, number = np.unique(np.stack([start, end]), return_inverse=True)
    a, b = number.reshape(2, -1)
    graph = coo_matrix((np.ones(len(a), np.int8), (a, b)), shape=(len(used), len(used)))
    loop: Ints = connected_components(graph, directed=False)[1][a].astype(np.int64)
    return loop
