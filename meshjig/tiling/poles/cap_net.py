"""Lay the tiles of a cap around its pole as a net: spokes to the pole, and borders around it."""

from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.tiling.graph import BESIDE
from meshjig.tiling.poles.net import Border, PolarBend, PolarNet, Reach
from meshjig.tiling.poles.plan import PolePlan
from meshjig.tiling.poles.poles import CapBorder

__all__ = ["around_chart", "polar_net"]

TIP = 0.35  # of a spoke from the pole, that no knob is on
STUB = 1.0  # mm of a spoke before the cap's border, straight: it has to meet the ring's cut there
UNEVEN = 1.5  # times as large as the smallest, the largest sector is where spokes go on
TURNS = 24  # tried for a row that begins where none of the outer one's spokes end


def polar_net(polygon: Any, pole: Floats, around: CapBorder, plan: PolePlan) -> PolarNet | None:
    """Lay the rows of a plan around a pole.

    Parameters
    ----------
    polygon : shapely.Polygon, the cap
    pole : (2,) float64, mm
    around : CapBorder, the ring's tiles along the cap's border
    plan : PolePlan, with more than a capstone that is the whole chart

    Returns
    -------
    PolarNet, or None where a spoke would leave the cap before the pole
    """
    import shapely

    angles = _angles(around.start - pole)
    ends = _towards(around, pole)
    spokes = shapely.linestrings(np.stack([np.broadcast_to(pole, ends.shape), ends], 1))
    round_once = ((np.roll(angles, -1) - angles) % (2 * np.pi)).sum() < 3 * np.pi
    if not round_once or not shapely.covers(polygon, spokes).all():
        return None
    made = PolarNet()
    rows = _spread(angles, plan.counts, polygon, pole)
    labels = [(-1 - around.tile).tolist(), *(made.own(n) for n in plan.counts)]
    reach = Reach(polygon, pole, angles, around.start, plan.levels[1:])
    centre = None if plan.capstone else made.node(pole)
    stone = made.own(1)[0] if plan.capstone else 0
    borders = [Border(made, reach, level) for level in plan.levels[1:]]
    for k, (turns, tiles) in enumerate(zip(rows, labels, strict=True)):
        for i, angle in enumerate(turns.tolist()):
            inner = borders[k].at(angle) if k < len(borders) else centre
            sides = tiles[i], tiles[i - 1]
            if inner is None:
                continue
            if k == 0:
                _spoke_to_border(made, inner, around.start[i], sides, inner == centre)
            else:
                _spoke(made, inner, borders[k - 1].at(angle), sides, inner == centre)
    for k, border in enumerate(borders):
        last = k == len(borders) - 1 and plan.capstone
        within = (np.zeros(1), [stone]) if last else (rows[k + 1], labels[k + 1])
        border.draw((rows[k], labels[k]), within)
    made.bend = PolarBend(pole, [border.circle() for border in borders])
    return made


def around_chart(polygon: Any) -> PolarNet:
    """Draw a loop around a chart that is one tile: nothing is cut, but all of it has a label."""
    import shapely

    loop = shapely.get_coordinates(shapely.buffer(polygon, 0.6 * BESIDE).simplify(0.1 * BESIDE).exterior)
    made = PolarNet()
    tile, beyond = made.own(2)
    if not shapely.is_ccw(shapely.LinearRing(loop)):
        loop = loop[::-1]
    number = [made.node(at) for at in loop[:-1]]
    for a, b in zip(number, [*number[1:], number[0]], strict=True):
        made.edge(a, b, tile, beyond, knob=False)
    return made


def _angles(away: Floats) -> Floats:
    """The angles of directions (n, 2), 0 to 2 pi."""
    angle: Floats = np.arctan2(away[:, 1], away[:, 0]) % (2 * np.pi)
    return angle


def _towards(around: CapBorder, pole: Floats) -> Floats:
    """The ends of spokes a little before the cap's border, (n, 2)."""
    away = pole - around.start
    length = np.linalg.norm(away, axis=1, keepdims=True)
    ends: Floats = around.start + away / length * np.minimum(STUB, length / 2)
    return ends


def _spread(outer: Floats, counts: tuple[int, ...], polygon: Any, pole: Floats) -> list[Floats]:
    """Where the tiles of each row begin, angles, from the outermost row inward."""
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
    """The share of a cap's area before angles seen from its pole, and these, 0 to 2 pi."""
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
