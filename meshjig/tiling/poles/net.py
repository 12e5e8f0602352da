"""A net around a pole: nodes and edges made one by one, and closed borders that are bent round."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.tiling.net import TileNet

__all__ = ["Border", "Circle", "PolarBend", "PolarNet", "Reach"]

FADED = 1.3  # times as far from the pole as the outermost border, nothing moves any more
NEAREST = 0.6  # of the distance to the cap's border, that the border inside it is drawn near the pole at most
SLANTED = 1.5  # times as far from the pole as the other, one end of a border's edge is where it has a knob
WIDEST = 1.6  # radians between corners of a border around the pole: more can't be bent round well


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
        """Map points (..., 2), mm."""
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
        last = wanted[0] * FADED
        after = np.where(before >= last, before, np.nan)
        outside = (last, last)
        for straight, around in [*zip(drawn, wanted, strict=True), (0 * last, 0 * last)]:
            share = (before - straight) / np.maximum(outside[0] - straight, 1e-300)
            here = np.isnan(after) & (before >= straight)
            after = np.where(here, around + share * (outside[1] - around), after)
            outside = straight, around
        bent: Floats = (self.pole + away * (after / before)[:, None]).reshape(points.shape)
        return bent


class PolarNet:
    """Nodes and edges, made one by one.

    Labels of tiles that are the cap's own count from 0; a ring's tile k is -1 - k.
    """

    def __init__(self) -> None:
        self.nodes: list[Floats] = []
        self.ends: list[tuple[int, int]] = []
        self.sides: list[tuple[int, int]] = []
        self.may_have_knob: list[bool] = []
        self.n_own = 0
        self.bend = PolarBend(np.zeros(2), [])

    def node(self, at: Floats) -> int:
        """Add a node."""
        self.nodes.append(at)
        return len(self.nodes) - 1

    def edge(self, start: int, stop: int, left: int, right: int, knob: bool) -> None:
        """Add an edge."""
        self.ends.append((start, stop))
        self.sides.append((left, right))
        self.may_have_knob.append(knob)

    def own(self, n: int) -> list[int]:
        """Add n tiles of the cap's own."""
        self.n_own += n
        return list(range(self.n_own - n, self.n_own))

    def net(self, ring_label: int) -> tuple[TileNet, Bools]:
        """The net, the ring's labels counted from a number, and which edges may have a knob."""
        sides = np.array(self.sides, np.int64)
        sides = np.where(sides < 0, ring_label - 1 - sides, sides)
        n, none = len(self.ends), np.zeros((len(self.ends), 2), np.int64)
        every: Ints = np.arange(n)
        return (
            TileNet(
                nodes=np.array(self.nodes),
                first_node=np.arange(len(self.nodes)),
                ends=np.array(self.ends, np.int64),
                left=sides[:, 0],
                right=sides[:, 1],
                kind=none[:, 0],
                copy=none,
                first_edge=every,
                turns=none[:, 0],
                n_tiles=self.n_own,
            ),
            np.array(self.may_have_knob),
        )


class Reach:
    """How far the cap's border is from the pole, by angle, and how far borders inside it are."""

    def __init__(
        self, polygon: Any, pole: Floats, angles: Floats, starts: Floats, levels: tuple[float, ...]
    ) -> None:
        self.polygon, self.pole, self.levels = polygon, pole, levels
        self.radius = float(np.sqrt(polygon.area / np.pi))
        self.known = dict(zip(angles.tolist(), np.linalg.norm(starts - pole, axis=1).tolist(), strict=True))
        low = np.array(polygon.bounds)
        self.far = float(np.hypot(*(low[2:] - low[:2])))

    def point(self, angle: float, level: float) -> Floats:
        """The point of a border at an angle; the outermost is as far from the cap's all around."""
        import shapely

        ahead = np.array([np.cos(angle), np.sin(angle)])
        if angle not in self.known:
            ray = shapely.LineString([self.pole, self.pole + self.far * ahead])
            hits = shapely.get_coordinates(ray.intersection(self.polygon.exterior))
            self.known[angle] = float(np.linalg.norm(hits - self.pole, axis=1).min())
        far = self.known[angle]
        first = max(far - (1 - self.levels[0]) * self.radius, far * min(NEAREST, self.levels[0]))
        place: Floats = self.pole + first * level / self.levels[0] * ahead
        return place

    def away(self, point: Floats) -> float:
        """The distance of a point from the pole."""
        return float(np.linalg.norm(point - self.pole))


class Border:
    """A closed border at one level, its nodes wherever a spoke ends on it."""

    def __init__(self, made: PolarNet, reach: Reach, level: float) -> None:
        self.made, self.reach, self.level = made, reach, level
        self.nodes: dict[float, int] = {}

    def at(self, angle: float) -> int:
        """The node at an angle, a new one if need be."""
        if angle not in self.nodes:
            self.nodes[angle] = self.made.node(self.reach.point(angle, self.level))
        return self.nodes[angle]

    def draw(self, outer: tuple[Floats, list[int]], inner: tuple[Floats, list[int]]) -> None:
        """Draw the border between two rows, each given by where its tiles begin, and the tiles."""
        turns = sorted(self.nodes)
        for a, b in zip(turns, [*turns[1:], turns[0] + 2 * np.pi], strict=True):
            parts = int(np.ceil((b - a) / WIDEST))
            for part in range(1, parts):
                self.at((a + (b - a) * part / parts) % (2 * np.pi))
        turns = sorted(self.nodes)
        for a, b in zip(turns, [*turns[1:], turns[0] + 2 * np.pi], strict=True):
            middle = (a + b) / 2
            start, stop = self.at(a), self.at(b if b in self.nodes else turns[0])
            far, near = (self.reach.away(self.made.nodes[node]) for node in (start, stop))
            knob = max(far, near) <= SLANTED * min(far, near)
            self.made.edge(start, stop, _tile_at(*inner, middle), _tile_at(*outer, middle), knob)

    def circle(self) -> Circle:
        """The border's corners in polar coordinates."""
        turns = sorted(self.nodes)
        away = np.array([self.made.nodes[self.nodes[turn]] for turn in turns]) - self.reach.pole
        return Circle(np.array(turns), np.linalg.norm(away, axis=1))


def _tile_at(turns: Floats, tiles: list[int], angle: float) -> int:
    """The tile of a row that lies at an angle."""
    begun = (angle - turns) % (2 * np.pi)
    return tiles[int(begun.argmin())]


def _radii(circle: Circle, angle: Floats) -> tuple[Floats, Floats]:
    """The radius of a polygon at angles (k,), and that of the curve that it becomes."""
    n = len(circle.angle)
    k = (np.searchsorted(circle.angle, angle, side="right") - 1) % n
    a, b = circle.radius[k], circle.radius[(k + 1) % n]
    span = (circle.angle[(k + 1) % n] - circle.angle[k]) % (2 * np.pi)
    ahead = (angle - circle.angle[k]) % (2 * np.pi)
    straight = a * b * np.sin(span) / (a * np.sin(ahead) + b * np.sin(span - ahead))
    return straight, a + (b - a) * ahead / span
