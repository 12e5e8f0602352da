"""Copies of a unit laid over a chart: corners, edges and tiles, each once."""

from dataclasses import dataclass

import numpy as np

from meshjig.mesh.types import Floats, Ints
from meshjig.tiling.placing import Placing
from meshjig.tiling.unit import Unit

__all__ = ["GRAIN", "Net", "copies_over", "distinct", "lay_net", "rounded", "unwrapped"]

GRAIN = 2.0**-18  # mm; coordinates are multiples of it, so that moving them by a period is exact


@dataclass(frozen=True)
class Net:
    """Corners, edges and tiles over one chart.

    Where the chart is periodic, nodes and edges may be copies of each other, whole periods apart; a
    tile and its copies have one number. Without a period everything is the only one of its kind.
    """

    nodes: Floats  # (n, 2), mm
    first_node: Ints  # (n,), the first of the nodes that are one
    ends: Ints  # (e, 2), nodes where an edge starts and stops
    left: Ints  # (e,), tile on its left
    right: Ints  # (e,), tile on its right
    kind: Ints  # (e,), which edge of the unit it is
    copy: Ints  # (e, 2), how often the unit is moved by each translation
    first_edge: Ints  # (e,), the first of the edges that are one
    turns: Ints  # (e,), periods that an edge lies after the first
    n_tiles: int


def rounded(points: Floats) -> Floats:
    """Round coordinates to whole grains."""
    whole: Floats = np.rint(points / GRAIN) * GRAIN
    return whole


def lay_net(unit: Unit, placing: Placing, bounds: Floats, margin: float) -> Net:
    """Lay copies of a unit over a box.

    Parameters
    ----------
    unit : Unit
    placing : Placing
    bounds : (4,) float64, mm, lowest and highest u and v: u0, v0, u1, v1
    margin : float, mm, how far beyond the box copies may lie

    Returns
    -------
    Net, with every edge that comes into the box
    """
    at = unit.corners[unit.ends[..., 0]] + unit.ends[..., 1:] @ unit.translations
    drawn = np.concatenate([at.reshape(-1, 2), *(unit.curves or ())])
    box = np.asarray(bounds) + margin * np.array([-1, -1, 1, 1])
    copies = copies_over(unit, drawn, placing, box)
    n, m = len(copies), len(unit.ends)
    kind = np.tile(np.arange(m), n)
    copy = np.repeat(copies, m, axis=0)
    ends = unit.ends[kind] + _moved(copy)
    sides = unit.sides[kind] + _moved(copy)
    home, turns = unwrapped(np.column_stack([kind, copy]), placing.wrap)
    corners, node = distinct(ends.reshape(-1, 3))
    corner_home, corner_turns = unwrapped(corners, placing.wrap)
    nodes = rounded(placing(unit.corners[corner_home[:, 0]] + corner_home[:, 1:] @ unit.translations))
    nodes[:, 0] += corner_turns * placing.period
    tiles, tile = distinct(unwrapped(sides.reshape(-1, 3), placing.wrap)[0])
    left, right = tile.reshape(-1, 2).T
    first_edge = _firsts(home)
    return Net(
        nodes=nodes,
        first_node=_firsts(corner_home),
        ends=node.reshape(-1, 2),
        left=left,
        right=right,
        kind=kind,
        copy=copy,
        first_edge=first_edge,
        turns=turns - turns[first_edge],
        n_tiles=len(tiles),
    )


def _moved(copy: Ints) -> Ints:
    """Give what is added to a unit's rows (tile or corner, i, j) of two ends or sides, (k, 1, 3)."""
    return np.column_stack([np.zeros(len(copy), np.int64), copy])[:, None]


def copies_over(unit: Unit, drawn: Floats, placing: Placing, box: Floats) -> Ints:
    """List the copies (k, 2) of what is drawn (n, 2), in the unit's lengths, that may come into a box."""
    lattice = np.linalg.inv(unit.translations)
    reach = drawn @ lattice
    corners = placing.back(np.array([[box[i], box[j]] for i in (0, 2) for j in (1, 3)])) @ lattice
    low = np.floor(corners.min(0) - reach.max(0)).astype(np.int64)
    high = np.ceil(corners.max(0) - reach.min(0)).astype(np.int64)
    i, j = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1), indexing="ij")
    copies = np.stack([i.ravel(), j.ravel()], 1)
    at = placing(copies @ unit.translations)
    extent = drawn @ placing.matrix
    touches = (at + extent.max(0) >= box[:2]).all(1) & (at + extent.min(0) <= box[2:]).all(1)
    return copies[touches]


def unwrapped(rows: Ints, wrap: tuple[int, int]) -> tuple[Ints, Ints]:
    """Give rows (number, i, j) less whole wraps, copies alike, and how many wraps that were, (k,)."""
    first, second = wrap
    if wrap == (0, 0):
        return rows, np.zeros(len(rows), np.int64)
    turns = (rows[:, 1] * first + rows[:, 2] * second) // (first * first + second * second)
    return rows - turns[:, None] * np.array([0, first, second]), turns


def distinct(rows: Ints) -> tuple[Ints, Ints]:
    """Give the distinct rows (k, 3), and the one that each row is."""
    _, first, which = np.unique(_keys(rows), return_index=True, return_inverse=True)
    return rows[first], which


def _firsts(rows: Ints) -> Ints:
    """Give the first row that is like each row, (k,)."""
    _, first, which = np.unique(_keys(rows), return_index=True, return_inverse=True)
    return first[which]


def _keys(rows: Ints) -> Ints:
    low = rows.min(0)
    span = rows.max(0) - low + 1
    return ((rows[:, 0] - low[0]) * span[1] + rows[:, 1] - low[1]) * span[2] + rows[:, 2] - low[2]
