"""Where and how a tiling is laid over a chart."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from meshjig.mesh.types import Bools, Floats, Ints
from meshjig.tiling.unit import Unit

__all__ = ["Placing", "bent_round", "placings_in_the_middle"]

WELL_BENT = 0.17  # logarithm of the stretch with which a tiling is still a good choice
MOST_BENT = 0.6  # and with which it is one at all, unless every other is worse


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
        """Carry points (..., 2) from the unit's plane to the chart's."""
        placed: Floats = points @ self.matrix + self.origin
        return placed

    def back(self, points: Floats) -> Floats:
        """Carry points (..., 2) from the chart's plane to the unit's."""
        lengths: Floats = (points - self.origin) @ np.linalg.inv(self.matrix)
        return lengths


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
