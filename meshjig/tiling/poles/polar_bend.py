"""Bend the straight edges around a pole to arcs, with the knobs on them."""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.types import Floats

__all__ = ["Circle", "PolarBend"]

FADED = 1.3  # times as far from the pole as the outermost border, nothing moves any more


class Circle(NamedTuple):
    """A closed border around a pole by its corners, in polar coordinates."""

    angle: Floats  # (n,), 0 to 2 pi, growing; no two as far apart as pi
    radius: Floats  # (n,), mm


class PolarBend:
    """A map of the plane that moves points along rays from a pole: polygons around it become round.

    Corners stay, and so does the plane farther out; rays stay straight.

    Parameters
    ----------
    pole : (2,) float64, mm
    circles : list of Circle, from the outermost inward, each inside the one before
    """

    def __init__(self, pole: Floats, circles: list[Circle]) -> None:
        self.pole, self.circles = pole, circles

    def __call__(self, points: Floats) -> Floats:
        """Carry points (..., 2), mm."""
        if not self.circles:
            return points
        away = points.reshape(-1, 2) - self.pole
        angle = np.arctan2(away[:, 1], away[:, 0]) % (2 * np.pi)
        before = np.maximum(np.linalg.norm(away, axis=1), 1e-300)
        drawn, wanted = [], []
        for circle in self.circles:
            straight, around = _radii(circle, angle)
            drawn.append(straight)
            wanted.append(around)
        rim = wanted[0] * FADED
        after = np.where(before >= rim, before, np.nan)
        outside = (rim, rim)
        for straight, around in [*zip(drawn, wanted, strict=True), (0 * rim, 0 * rim)]:
            share = (before - straight) / np.maximum(outside[0] - straight, 1e-300)
            here = np.isnan(after) & (before >= straight)
            after = np.where(here, around + share * (outside[1] - around), after)
            outside = straight, around
        bent: Floats = (self.pole + away * (after / before)[:, None]).reshape(points.shape)
        return bent


def _radii(circle: Circle, angle: Floats) -> tuple[Floats, Floats]:
    """Give the radius of a polygon at angles (k,), and that of the curve that it becomes."""
    n = len(circle.angle)
    k = (np.searchsorted(circle.angle, angle, side="right") - 1) % n
    a, b = circle.radius[k], circle.radius[(k + 1) % n]
    span = (circle.angle[(k + 1) % n] - circle.angle[k]) % (2 * np.pi)
    ahead = (angle - circle.angle[k]) % (2 * np.pi)
    straight = a * b * np.sin(span) / (a * np.sin(ahead) + b * np.sin(span - ahead))
    return straight, a + (b - a) * ahead / span
