"""Draw the tiles of a cap around its pole as a net: spokes to the pole, and borders around it."""

from typing import Any

import numpy as np

from meshjig.mesh.types import Floats
from meshjig.tiling.graph import BESIDE
from meshjig.tiling.poles.polar_bend import Circle, PolarBend
from meshjig.tiling.poles.polar_graph import PolarNet
from meshjig.tiling.poles.polar_plan import PolePlan
from meshjig.tiling.poles.poles import Rim

__all__ = ["polar_net"]

TIP = 0.35  # of a spoke from the pole, that no knob is on
STUB = 1.0  # mm of a spoke before the cap's border, straight: it has to meet the ring's cut there
NEAREST = 0.6  # of the way to the cap's border, that the border inside it is drawn near the pole at most
SLANTED = 1.5  # times as far from the pole as the other, one end of a border's edge is where it has a knob
WIDEST = 1.6  # radians between corners of a border around the pole: more can't be bent round well
UNEVEN = 1.5  # times as large as the smallest, the largest sector is where spokes go on
TURNS = 24  # tried for a row that begins where none of the outer one's spokes end


def polar_net(polygon: Any, pole: Floats, rim: Rim, plan: PolePlan) -> PolarNet | None:
    """Lay the rows of a plan around a pole.

    Parameters
    ----------
    polygon : shapely.Polygon, the cap
    pole : (2,) float64, mm
    rim : Rim, the ring's tiles along the cap's border
    plan : PolePlan, with more than a capstone that is the whole chart

    Returns
    -------
    PolarNet, or None where a spoke would leave the cap on its way to the pole
    """
    import shapely

    angles = _angles(rim.start - pole)
    spokes = shapely.linestrings(np.stack([np.broadcast_to(pole, rim.start.shape), _towards(rim, pole)], 1))
    round_once = ((np.roll(angles, -1) - angles) % (2 * np.pi)).sum() < 3 * np.pi
    if not round_once or not shapely.covers(polygon, spokes).all():
        return None
    made = PolarNet()
    rows = _spread(angles, plan.counts, polygon, pole)
    labels = [(-1 - rim.tile).tolist(), *(made.own(n) for n in plan.counts)]
    reach = _Reach(polygon, pole, angles, rim.start, plan.levels[1:])
    centre = None if plan.capstone else made.node(pole)
    stone = made.own(1)[0] if plan.capstone else 0
    borders = [_Border(made, reach, level) for level in plan.levels[1:]]
    for k, (turns, tiles) in enumerate(zip(rows, labels, strict=True)):
        for i, angle in enumerate(turns.tolist()):
            inner = borders[k].at(angle) if k < len(borders) else centre
            sides = tiles[i], tiles[i - 1]
            if inner is None:
                continue
            if k == 0:
                _spoke_to_border(made, inner, rim.start[i], sides, inner == centre)
            else:
                _spoke(made, inner, borders[k - 1].at(angle), sides, inner == centre)
    for k, border in enumerate(borders):
        last = k == len(borders) - 1 and plan.capstone
        within = (np.zeros(1), [stone]) if last else (rows[k + 1], labels[k + 1])
        border.draw((rows[k], labels[k]), within)
    made.bend = PolarBend(pole, [border.circle() for border in borders])
    return made


class _Reach:
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
        """Give the point of a border at an angle; the outermost is as far from the cap's all around."""
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
        """Give how far from the pole a point is."""
        return float(np.linalg.norm(point - self.pole))


class _Border:
    """A closed border at one level, its nodes wherever a spoke ends on it."""

    def __init__(self, made: PolarNet, reach: _Reach, level: float) -> None:
        self.made, self.reach, self.level = made, reach, level
        self.nodes: dict[float, int] = {}

    def at(self, angle: float) -> int:
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
        """Give the border's corners in polar coordinates."""
        turns = sorted(self.nodes)
        away = np.array([self.made.nodes[self.nodes[turn]] for turn in turns]) - self.reach.pole
        return Circle(np.array(turns), np.linalg.norm(away, axis=1))


def _tile_at(turns: Floats, tiles: list[int], angle: float) -> int:
    """Give the tile of a row that lies at an angle."""
    begun = (angle - turns) % (2 * np.pi)
    return tiles[int(begun.argmin())]


def _angles(away: Floats) -> Floats:
    """Give the angles of directions (n, 2), 0 to 2 pi."""
    angle: Floats = np.arctan2(away[:, 1], away[:, 0]) % (2 * np.pi)
    return angle


def _towards(rim: Rim, pole: Floats) -> Floats:
    """Give the ends of spokes a little before the cap's border, (n, 2)."""
    away = pole - rim.start
    length = np.linalg.norm(away, axis=1, keepdims=True)
    ends: Floats = rim.start + away / length * np.minimum(STUB, length / 2)
    return ends


def _spread(outer: Floats, counts: tuple[int, ...], polygon: Any, pole: Floats) -> list[Floats]:
    """Give where the tiles of each row begin, angles, from the outermost row inward."""
    share, angle = _shares(polygon, pole)
    rows = [outer]
    for n in counts:
        before = rows[-1]
        if len(before) % n == 0:  # every second spoke goes on, or every third ...
            turns = before[:: len(before) // n]
            area = np.diff(np.sort(np.interp(turns, angle, share)), append=np.nan)
            area[-1] = 1 - area[:-1].sum()
            if area.max() <= UNEVEN * area.min():
                rows.append(turns)
                continue
        begin = (np.arange(n)[None] + np.arange(TURNS)[:, None] / TURNS) / n
        tried = np.interp(begin, share, angle)
        apart = np.abs((tried[:, :, None] - before + np.pi) % (2 * np.pi) - np.pi).min((1, 2))
        rows.append(tried[int(apart.argmax())] % (2 * np.pi))
    return rows


def _shares(polygon: Any, pole: Floats) -> tuple[Floats, Floats]:
    """Give the share of a cap's area before angles seen from its pole, and these, 0 to 2 pi."""
    import shapely

    step = 0.02 * float(np.sqrt(polygon.area))
    xy = shapely.get_coordinates(shapely.segmentize(polygon.exterior, step)) - pole
    a, b = xy[:-1], xy[1:]
    area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    middle = _angles(a + b)
    order = np.argsort(middle, kind="stable")
    before = np.cumsum(area[order]) - area[order] / 2
    share = np.concatenate([[0.0], before / area.sum(), [1.0]])
    return share, np.concatenate([[0.0], middle[order], [2 * np.pi]])


def _spoke(made: PolarNet, start: int, stop: int, sides: tuple[int, int], at_pole: bool) -> None:
    if at_pole:
        a, b = made.nodes[start], made.nodes[stop]
        tip = made.node(a + TIP * (b - a))
        made.edge(start, tip, *sides, knob=False)
        start = tip
    made.edge(start, stop, *sides, knob=True)


def _spoke_to_border(
    made: PolarNet, start: int, border: Floats, sides: tuple[int, int], at_pole: bool
) -> None:
    """Draw a spoke that crosses the cap's border where it has to, and goes on a little beyond."""
    away = border - made.nodes[start]
    length = float(np.linalg.norm(away))
    stub = made.node(border - away * min(STUB / length, 0.4))
    _spoke(made, start, stub, sides, at_pole)
    made.edge(stub, made.node(border + away / length * 0.9 * BESIDE), *sides, knob=False)
