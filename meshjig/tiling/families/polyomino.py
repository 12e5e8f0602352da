"""Polyominoes, grown at random from the squares of a torus, with a knob on every square's edge."""

import numpy as np
from numpy.random import Generator

from meshjig.mesh.arrays import Ints
from meshjig.tiling.template import Template, classic, enlarged
from meshjig.tiling.unit import Unit

__all__ = ["SQUARES", "polyomino"]

SQUARES = 4  # to a tile on average
_AROUND = 12  # squares after which the tiling repeats
_LARGER = 1.25  # as much as leaves room beside a knob from the next edge
_LARGEST = 6  # squares; fewer than seven enclose no hole
_BESIDE = ((1, 0), (0, 1), (-1, 0), (0, -1))

Cell = tuple[int, int]  # a square of the plane; on the torus it is the same as those a period away
Tiles = dict[int, list[Cell]]
Owner = dict[Cell, tuple[int, Cell]]  # of the torus's squares: the tile, and the square as it lists it


def polyomino(seed: int = 0, columns: int | None = None) -> Unit:
    """Grow polyominoes of four squares on average, six at most, without holes.

    Parameters
    ----------
    seed : int
    columns : int, at least 1, optional
        Squares along the first translation, so that the tiling closes around a periodic chart. A square
        is half as wide as that of a mean tile's area; with one column, every tile is one square.

    Returns
    -------
    Unit
    """
    period = (columns or _AROUND, _AROUND)
    n_squares = period[0] * period[1]
    tiles = _grow(*period, round(n_squares / SQUARES), np.random.default_rng(seed))
    owner = {_home(cell, period): (tile, cell) for tile, cells in enumerate(tiles) for cell in cells}
    ends, sides = [], []
    for i, j in sorted(owner):
        for right, start, stop in (((i, j - 1), (i, j), (i + 1, j)), ((i - 1, j), (i, j + 1), (i, j))):
            left, across = _side(owner, (i, j), period), _side(owner, right, period)
            if left != across:
                ends.append([_reference(start, period), _reference(stop, period)])
                sides.append([left, across])
    return _unit(np.array(ends), np.array(sides), period, len(tiles))


def _unit(ends: Ints, sides: Ints, period: Cell, n_tiles: int) -> Unit:
    edge = np.sqrt(n_tiles / (period[0] * period[1]))
    used, corner = np.unique(ends[..., 0], return_inverse=True)
    return Unit(
        translations=edge * np.diag(period).astype(np.float64),
        corners=edge * np.stack([used % period[0], used // period[0]], 1),
        ends=np.concatenate([corner.reshape(-1, 2, 1), ends[..., 1:]], 2),
        sides=sides,
        n_tiles=n_tiles,
        template=_knob,
        knob_side=np.zeros(len(ends), np.int64),
    )


def _knob(n: int) -> Template:
    return enlarged(classic(n), _LARGER)


def _home(cell: Cell, period: Cell) -> Cell:
    return cell[0] % period[0], cell[1] % period[1]


def _reference(node: Cell, period: Cell) -> tuple[int, int, int]:
    """Number a corner of the torus's squares, and say how far the named one is moved."""
    i, j = _home(node, period)
    return period[0] * j + i, node[0] // period[0], node[1] // period[1]


def _side(owner: dict[Cell, tuple[int, Cell]], cell: Cell, period: Cell) -> tuple[int, int, int]:
    """Name the tile, and how far it is moved, that a square of the plane belongs to."""
    tile, listed = owner[_home(cell, period)]
    return tile, (cell[0] - listed[0]) // period[0], (cell[1] - listed[1]) // period[1]


def _grow(columns: int, rows: int, n: int, rng: Generator) -> list[list[Cell]]:
    """Merge the squares of a torus into polyominoes of even size.

    The smallest polyomino joins its smallest neighbour, by chance among equals, as long as the two make
    no more than six squares and don't touch their own copies, a period away: so none encloses a hole
    and none goes around the torus.

    Parameters
    ----------
    columns, rows : int, squares around the torus
    n : int, polyominoes to stop at; there are more where the torus is too narrow to merge them
    rng : numpy Generator

    Returns
    -------
    list of list of (int, int)
        The squares of each, connected in the plane: some may lie outside of the torus's first period.
    """
    period = (columns, rows)
    tiles = {columns * j + i: [(i, j)] for j in range(rows) for i in range(columns)}
    owner = {cells[0]: (tile, cells[0]) for tile, cells in tiles.items()}
    while len(tiles) > n:
        pair = _next_pair(tiles, owner, period, rng)
        if pair is None:
            break
        kept, gone, moved = pair
        del tiles[gone]
        tiles[kept] += moved
        owner.update({(i % columns, j % rows): (kept, (i, j)) for i, j in moved})
    return list(tiles.values())


def _next_pair(
    tiles: Tiles, owner: Owner, period: Cell, rng: Generator
) -> tuple[int, int, list[Cell]] | None:
    """Choose a tile, one to join it, and where the latter's squares lie beside the former."""
    chance = dict(zip(tiles, rng.permutation(len(tiles)).tolist(), strict=True))
    for tile in sorted(tiles, key=lambda tile: (len(tiles[tile]), chance[tile])):
        choices = []
        for other, by in _neighbours(tiles[tile], owner, period):
            moved = [(i + by[0], j + by[1]) for i, j in tiles[other]]
            joined = tiles[tile] + moved
            if other != tile and len(joined) <= _LARGEST and _is_apart(joined, period):
                choices.append((len(moved), chance[other], other, moved))
        if choices:
            *_, other, moved = min(choices)
            return tile, other, moved
    return None


def _neighbours(cells: list[Cell], owner: Owner, period: Cell) -> set[tuple[int, Cell]]:
    """The tiles around, and how far their squares are moved to lie there."""
    found = set()
    for i, j in cells:
        for di, dj in _BESIDE:
            at = (i + di, j + dj)
            other, stored = owner[at[0] % period[0], at[1] % period[1]]
            found.add((other, (at[0] - stored[0], at[1] - stored[1])))
    return found


def _is_apart(cells: list[Cell], period: Cell) -> bool:
    """Tell whether no square touches a copy of another, by a side or at a corner."""
    own = set(cells)
    around = {(i + di, j + dj) for i, j in cells for di in (-1, 0, 1) for dj in (-1, 0, 1)} - own
    homes = {(i % period[0], j % period[1]) for i, j in own}
    return len(homes) == len(own) and not any((i % period[0], j % period[1]) in homes for i, j in around)
