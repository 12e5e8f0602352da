"""What is repeated: a few tiles whose copies by two translations cover the plane; their edges, outlines."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import closed_loops
from meshjig.tiling.template import Template, along

__all__ = ["Step", "Unit", "edge_curves", "edge_ends", "knob_sides", "tile_outlines", "tile_steps"]

_POINTS = 8  # a part of a knob, fine enough for a drawing


@dataclass(frozen=True)
class Unit:
    """Tiles, corners and edges of one translational unit, in lengths at which the mean tile has area 1.

    Row k of an array with three columns names corner or tile k[0], moved k[1] times by the first
    translation and k[2] times by the second.
    """

    translations: Floats  # (2, 2), a vector a row, the second on the left of the first
    corners: Floats  # (c, 2), where tiles meet
    ends: Ints  # (e, 2, 3), the corners where an edge starts and stops
    sides: Ints  # (e, 2, 3), the tiles on its left and on its right
    n_tiles: int
    curves: tuple[Floats, ...] | None = None
    """A polyline (n, 2) an edge, both its ends included, where tiles interlock by their shape."""

    template: Callable[[int], Template] | None = None
    """Where edges are straight instead: the knob that they carry, drawn with n points a part."""

    knob_side: Ints | None = None
    """(e,), 1: an edge's knob points to its left, -1: to its right, 0: to either."""


class Step(NamedTuple):
    """One edge on the path around a tile."""

    edge: int
    forward: bool  # along the edge, the tile on its left
    shift: tuple[int, int]  # the copy of the edge


def edge_ends(unit: Unit) -> Floats:
    """Place the ends of a unit's edges.

    Returns
    -------
    (e, 2, 2) float64, start and stop
    """
    return unit.corners[unit.ends[..., 0]] + unit.ends[..., 1:] @ unit.translations


def knob_sides(unit: Unit) -> Ints:
    """Decide for every edge: 1, knob to its left, or -1; they alternate where either will do.

    Returns
    -------
    (e,) int64
    """
    alternating = 1 - 2 * (np.arange(len(unit.ends)) % 2)
    if unit.knob_side is None:
        return alternating
    return np.where(unit.knob_side == 0, alternating, unit.knob_side)


def edge_curves(unit: Unit, sides: Ints | None = None) -> list[Floats]:
    """Draw the edges as they are cut.

    Parameters
    ----------
    unit : Unit
    sides : (e,) int64, 1 or -1, where the knobs of straight edges point; else as `knob_sides`

    Returns
    -------
    list of (n, 2) float64, from an edge's start to its end
    """
    if unit.curves is not None:
        return list(unit.curves)
    ends = edge_ends(unit)
    if unit.template is None:
        return list(ends)
    sides = knob_sides(unit) if sides is None else sides
    knob = unit.template(_POINTS).points
    drawn = along(np.stack([np.tile(knob[:, 0], (len(ends), 1)), sides[:, None] * knob[:, 1]], -1), ends)
    drawn[:, -1] = ends[:, 1]
    return list(drawn)


def tile_steps(unit: Unit) -> list[list[Step]]:
    """Walk around every tile, itself on the left.

    Returns
    -------
    list of list of Step, one a tile

    Raises
    ------
    ValueError
        A tile's edges are no single closed path that visits each of its corners once.
    """
    return [_path_around(unit, tile) for tile in range(unit.n_tiles)]


def tile_outlines(unit: Unit, curves: list[Floats]) -> list[Floats]:
    """Draw the tiles.

    Parameters
    ----------
    unit : Unit
    curves : list of (n, 2) float64, see `edge_curves`

    Returns
    -------
    list of (k, 2) float64, counterclockwise, the first point not repeated

    Raises
    ------
    ValueError
        As `tile_steps`.
    """
    return [
        np.vstack([_drawn(unit, curves[step.edge], step)[:-1] for step in steps])
        for steps in tile_steps(unit)
    ]


def _drawn(unit: Unit, curve: Floats, step: Step) -> Floats:
    return (curve if step.forward else curve[::-1]) + np.array(step.shift) @ unit.translations


def _path_around(unit: Unit, tile: int) -> list[Step]:
    edge, side = np.nonzero(unit.sides[..., 0] == tile)
    if not len(edge):
        raise ValueError(f"tile {tile} has no edge")
    shift = -unit.sides[edge, side, 1:]
    ends = np.where(side[:, None, None] == 0, unit.ends[edge], unit.ends[edge][:, ::-1])
    ends[..., 1:] += shift[:, None]
    start, stop = np.unique(ends.reshape(-1, 3), axis=0, return_inverse=True)[1].reshape(-1, 2).T
    repeated = np.delete(np.arange(len(start)), np.unique(start, return_index=True)[1])
    if len(repeated):
        raise ValueError(f"tile {tile} comes twice through corner {ends[repeated[0], 0, 0]}")
    closed = np.array_equal(np.sort(start), np.sort(stop))
    if not closed or len(loops := closed_loops(start, stop)) > 1:
        raise ValueError(f"the edges of tile {tile} are not one closed loop")
    path = np.roll(loops[0], -int(start[loops[0]].argmin()))
    rows = np.column_stack([edge, side == 0, shift])[path].tolist()
    return [Step(k, bool(forward), (i, j)) for k, forward, i, j in rows]
