"""Where a tiling is laid over each chart: in the middle, bent round, or where few tiles are clipped."""

from collections.abc import Sequence
from dataclasses import replace
from operator import itemgetter
from typing import Any

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.tiling.net import Placing
from meshjig.tiling.shapes import TileShapes
from meshjig.tiling.unit import Unit

__all__ = ["Fit", "bent_round", "placings_in_the_middle"]

WELL_BENT = 0.17  # logarithm of the stretch with which a tiling is still a good choice
MOST_BENT = 0.6  # and with which it is one at all, unless every other is worse
FINENESS = 6  # samples along a tile's edge
MOST_SAMPLES = 20_000  # of all charts
TURNED = (0.0, 15.0, 30.0, 45.0)  # degrees off a chart's long axis
PLACES = 4  # tried along a translation as long as a tile
BESIDE_KNOBS = 0.28  # of a tile: there fewest knobs meet the closing line
OFF = 0.01  # of a tile, that a first row begins beyond the chart: no cut may run along its border
EVEN = np.array([0.7548776662466927, 0.5698402909980532])  # multiples of these fill a square evenly
SMALL = 1 / 3  # of a tile: less than that is clipped small
BENT = 0.3  # how much worse a tiling is for being stretched e times along a period
ASKEW = 0.03  # what a tiling must be better by to lie across a chart's long axis


def bent_round(unit: Unit, size: float, period: float, angle: float = 0.0) -> list[Placing]:
    """Bend a tiling so that it repeats after a period along u, the least bent first.

    A translation of the tiling that nearly spans the period is turned and scaled to span it; across,
    the tiling is scaled the other way, so that tiles keep their area.

    Parameters
    ----------
    unit : Unit
    size : float, mm
    period : float, mm
    angle : float, degrees, how the unit is turned before it is bent

    Returns
    -------
    list of Placing, at least one, with their origin at (0, 0)
    """
    most = int(np.ceil(2 * period / (size * np.linalg.norm(unit.translations, axis=1).min()))) + 2
    i, j = (x.ravel() for x in np.meshgrid(np.arange(-most, most + 1), np.arange(-most, most + 1)))
    ahead = size * np.stack([i, j], 1) @ unit.translations
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    ahead = ahead @ np.array([[c, s], [-s, c]])
    off = np.hypot(ahead[:, 0] - period, ahead[:, 1])
    off[ahead[:, 0] <= 0] = np.inf
    stretch = period / np.maximum(np.linalg.norm(ahead, axis=1), 1e-300)
    bent = np.abs(np.log(stretch))
    apart = np.flatnonzero(~_meets_itself(unit, i, j) & np.isfinite(off))
    order = apart[np.argsort(off[apart], kind="stable")][:8]
    if bent[order[0]] > MOST_BENT:  # too thin for two tiles around: rings
        order = np.argsort(off, kind="stable")[:1]
    good = order[(off[order] <= off[order[0]]) | (bent[order] <= WELL_BENT)]
    return [
        Placing(
            size,
            angle - float(np.degrees(np.arctan2(ahead[k, 1], ahead[k, 0]))),
            stretch=float(stretch[k]),
            period=period,
            wrap=(int(i[k]), int(j[k])),
        )
        for k in good.tolist()
    ]


def placings_in_the_middle(
    unit: Unit,
    polygons: Sequence[Any],
    periods: Floats,
    size: float,
) -> list[Placing]:
    """Lay a tiling over every chart, its origin half a tile below and left of the middle of the box.

    Parameters
    ----------
    unit : Unit
    polygons : sequence of shapely.Polygon, the charts
    periods : (c,) float64, mm
    size : float, mm

    Returns
    -------
    list of Placing, one a chart
    """
    placings = []
    for polygon, period in zip(polygons, periods.tolist(), strict=True):
        u0, v0, u1, v1 = polygon.bounds
        origin = np.array([u0 + u1, v0 + v1]) / 2 - size / 2
        bent = bent_round(unit, size, period)[0] if period else Placing(size)
        placings.append(replace(bent, origin=origin))
    return placings


class Fit:
    """Samples of charts, on which places of a tiling are tried.

    Parameters
    ----------
    polygons : sequence of shapely.Polygon, the charts
    periods : (c,) float64, mm
    shapes : TileShapes
    size : float, mm, about that of the tiles
    angle : float, degrees, optional
        How the tiling is turned in every chart; chosen for each if not given.
    """

    def __init__(
        self,
        polygons: Sequence[Any],
        periods: Floats,
        shapes: TileShapes,
        size: float,
        angle: float | None = None,
    ) -> None:
        area = sum(polygon.area for polygon in polygons)
        self.spacing = max(size / FINENESS, float(np.sqrt(area / MOST_SAMPLES)))
        self.shapes, self.periods = shapes, periods
        self.angles = TURNED if angle is None else (angle,)
        self.bounds = [np.array(polygon.bounds) for polygon in polygons]
        self.samples = [_inside(polygon, self.spacing) for polygon in polygons]
        self._angles = [self.angles] * len(self.bounds)

    def placings(self, size: float, n: int) -> list[tuple[Placing, ...]]:
        """Place tiles of a size in mm on every chart, as well as found, then second best, and so on.

        Returns
        -------
        list of n tuples of Placing, one a chart
        """
        return list(zip(*(self._best(c, size, n) for c in range(len(self.bounds))), strict=True))

    def _best(self, chart: int, size: float, n: int) -> list[Placing]:
        """The n best places in one chart; with the first size tried its angle is chosen, too."""
        low = self.bounds[chart][:2] - OFF * size
        turned = [replace(placing, origin=low) for placing in self._turned(chart, size)]
        tried = []
        for placing in turned:
            moves = self.shapes.unit.translations @ placing.matrix
            shifts = _shifts(moves, placing)
            costs = self._cost(placing, chart, shifts).tolist()
            tried += [(cost, low - shift @ moves, placing) for cost, shift in zip(costs, shifts, strict=True)]
        tried.sort(key=itemgetter(0))
        self._angles[chart] = (tried[0][2].angle,)
        return [replace(placing, origin=origin) for _, origin, placing in tried[:n]]

    def _turned(self, chart: int, size: float) -> list[Placing]:
        period = float(self.periods[chart])
        if period:
            return bent_round(self.shapes.unit, size, period, self.angles[0])[:PLACES]
        return [Placing(size, angle) for angle in self._angles[chart]]

    def _cost(self, placing: Placing, chart: int, shifts: Floats) -> Floats:
        points = self.samples[chart]
        area = self.shapes.counts(placing, points, shifts) * (self.spacing / placing.size) ** 2
        whole = len(points) * (self.spacing / placing.size) ** 2
        area = np.minimum(area, 1)
        small = ((area > 0) & (area < SMALL)).sum(1) + np.where(area < SMALL, area, 0).sum(1)
        clipped = (area * (1 - area)).sum(1)
        bent = BENT * abs(np.log(placing.stretch)) if placing.period else ASKEW * (placing.angle != 0)
        return (small + clipped) / whole + bent


def _shifts(moves: Floats, placing: Placing) -> Floats:
    """Spread places over a unit, (s, 2), in its translations (2, 2), mm."""
    length = np.linalg.norm(moves, axis=1) / placing.size
    n = np.clip(np.rint(PLACES * length).astype(int), PLACES, 2 * PLACES)
    steps = [np.arange(k) / k for k in n.tolist()]
    if placing.period:  # what counts is how rows lie between the borders
        across = int(np.abs(moves[:, 1]).argmax())
        steps[across] = np.arange(2 * n[across]) / (2 * n[across])
        steps[1 - across] = BESIDE_KNOBS / length[1 - across : 2 - across]
    shifts: Floats = np.stack(np.meshgrid(*steps, indexing="ij"), -1).reshape(-1, 2)
    return shifts


def _inside(polygon: Any, spacing: float) -> Floats:
    """Spread points evenly inside a polygon, about one to the square of a spacing, at least one."""
    import shapely

    low, high = np.array(polygon.bounds).reshape(2, 2)
    n = int(np.prod(high - low) / spacing**2) + 1
    points = low + (high - low) * ((np.arange(n)[:, None] + 0.5) * EVEN % 1)
    shapely.prepare(polygon)
    points = points[shapely.contains_xy(polygon, points)]
    return points if len(points) else shapely.get_coordinates(polygon.representative_point())


def _meets_itself(unit: Unit, i: Ints, j: Ints) -> Bools:
    """Tell after which translations a tile would touch itself, at an edge or at a corner."""
    corner = np.repeat(unit.ends, 2, axis=1).reshape(-1, 3)
    tile = np.tile(unit.sides, (1, 2, 1)).reshape(-1, 3)
    at = np.unique(np.column_stack([corner[:, 0], tile[:, 0], tile[:, 1:] - corner[:, 1:]]), axis=0)
    moves = [np.zeros((1, 2), np.int64)]
    for k in range(1, len(at)):  # rows of one corner and one tile follow each other
        same = (at[k:, :2] == at[:-k, :2]).all(1)
        if not same.any():
            break
        between = (at[k:] - at[:-k])[same, 2:]
        moves += [between, -between]
    touches: Bools = (np.stack([i, j], 1)[:, None] == np.unique(np.concatenate(moves), axis=0)).all(2).any(1)
    return touches
