"""Copies of a unit laid over a chart: corners, edges and tiles, each once."""

from dataclasses import dataclass, field

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.types import UV_GRID
from meshjig.tiling.unit import Unit, edge_ends

__all__ = [
    "UV_GRID",
    "Placing",
    "TileNet",
    "copies_over",
    "distinct",
    "first_alike",
    "lay_net",
    "rounded",
    "row_keys",
    "unwrapped",
]


@dataclass(frozen=True)
class Placing:
    """A map from a unit's lengths to a chart's mm: turned, scaled to the size, stretched, moved."""

    size: float  # mm, the edge of a square as large as the mean tile
    angle: float = 0.0  # degrees that the unit is turned by
    origin: Floats = field(default_factory=lambda: np.zeros(2))  # (2,), mm, where the unit's (0, 0) goes
    stretch: float = 1.0  # what u is scaled by after turning, and v by its inverse
    period: float = 0.0  # mm along u after which the tiling repeats; 0 where it need not
    wrap: tuple[int, int] = (0, 0)  # the translations that make up one period

    @property
    def matrix(self) -> Floats:
        """The map's linear part, (2, 2): row vectors are multiplied from the left."""
        c, s = np.cos(np.radians(self.angle)), np.sin(np.radians(self.angle))
        turn = np.array([[c, s], [-s, c]])
        linear: Floats = self.size * turn * np.array([self.stretch, 1 / self.stretch])
        return linear

    def __call__(self, points: Floats) -> Floats:
        """Map points (..., 2) from the unit's plane to the chart's."""
        placed: Floats = points @ self.matrix + self.origin
        return placed

    def back(self, points: Floats) -> Floats:
        """Map points (..., 2) from the chart's plane to the unit's."""
        lengths: Floats = (points - self.origin) @ np.linalg.inv(self.matrix)
        return lengths


@dataclass(frozen=True)
class TileNet:
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
    whole: Floats = np.rint(points / UV_GRID) * UV_GRID
    return whole


def lay_net(unit: Unit, placing: Placing, bounds: Floats, margin: float) -> TileNet:
    """Lay copies of a unit over a box.

    Parameters
    ----------
    unit : Unit
    placing : Placing
    bounds : (4,) float64, mm, lowest and highest u and v: u0, v0, u1, v1
    margin : float, mm, how far beyond the box copies may lie

    Returns
    -------
    TileNet, with every edge that comes into the box
    """
    at = edge_ends(unit)
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
    first_edge = first_alike(row_keys(home)[0])
    return TileNet(
        nodes=nodes,
        first_node=first_alike(row_keys(corner_home)[0]),
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
    """What is added to a unit's rows (tile or corner, i, j) of two ends or sides, (k, 1, 3)."""
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
    """Rows (number, i, j) less whole wraps, copies alike, and how many wraps that were, (k,)."""
    first, second = wrap
    if wrap == (0, 0):
        return rows, np.zeros(len(rows), np.int64)
    turns = (rows[:, 1] * first + rows[:, 2] * second) // (first * first + second * second)
    return rows - turns[:, None] * np.array([0, first, second]), turns


def distinct(rows: Ints) -> tuple[Ints, Ints]:
    """The distinct rows (k, 3), and the one that each row is."""
    _, first, which = np.unique(row_keys(rows)[0], return_index=True, return_inverse=True)
    return rows[first], which


def first_alike(values: Ints) -> Ints:
    """The place of the first value that is like each value, (k,)."""
    _, first, which = np.unique(values, return_index=True, return_inverse=True)
    return first[which]


def row_keys(rows: Ints) -> tuple[Ints, int]:
    """One number for every row (k, 3), alike for rows that are alike, and what all of them lie below."""
    low = rows.min(0)
    span = rows.max(0) - low + 1
    key = ((rows[:, 0] - low[0]) * span[1] + rows[:, 1] - low[1]) * span[2] + rows[:, 2] - low[2]
    return key, int(span.prod())
