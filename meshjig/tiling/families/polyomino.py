"""Polyominoes, grown at random from the squares of a torus, with a knob on every square's edge."""

import numpy as np

from meshjig.mesh.types import Ints
from meshjig.tiling.classic import classic
from meshjig.tiling.enlarge import enlarged
from meshjig.tiling.families.grow_polyomino import Cell, grow
from meshjig.tiling.template import Template
from meshjig.tiling.unit import Unit

__all__ = ["SQUARES", "polyomino"]

SQUARES = 4  # to a tile on average
_AROUND = 12  # squares after which the tiling repeats
_LARGER = 1.25  # as much as leaves room beside a knob from the next edge


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
    tiles = grow(*period, round(n_squares / SQUARES), np.random.default_rng(seed))
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
