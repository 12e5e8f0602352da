"""Give straight edges their knobs, where there is room for one."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.tiling.domain import Stretch
from meshjig.tiling.knob_clearance import surroundings
from meshjig.tiling.template import Template, along

__all__ = ["CLEAR", "Chances", "KnobRules", "choose_knobs"]

CLEAR = 0.05  # of a tile's size, that knobs keep from the chart's border and from each other
JITTER = 0.06  # of an edge, that a knob to either side is off its place by chance, when all is random
SMALLER, LARGER = 0.85, 1.1  # how much knobs vary in size by chance, when all is random
LEAN = 0.3  # of its height, that a knob's top is moved sideways then
FARTHEST = 0.2  # of an edge, that a knob is moved from the middle for its own good
LARGEST = 1.75  # times its size, that a knob grows for its neck to be as wide as asked, unless told otherwise
STRETCH = 1.05  # of the neck asked for: across a knob, charts are stretched unevenly
LEAST_HEAD = 1.3  # widths of the neck, after bending
# the scale before and this one; place, None for the middle of what lies inside the chart; side
_SCALES = ((np.inf, 1.0), (1.0, 0.85), (0.85, 0.7))
_TRIES = [(*k, p, s) for k in _SCALES for p in (None, -0.12, 0.12) for s in (1.0, -1.0)]


class Variations(NamedTuple):
    """How each of several knobs is drawn by chance, (n,) each."""

    side: Floats  # 1 or -1
    place: Floats  # off the middle of its edge
    lean: Floats
    scale: Floats


class Chances(NamedTuple):
    """What is left to chance about the knobs of one chart."""

    seed: int
    chart: int
    random: float  # 0 to 1, how much knobs vary in place, size and lean; sides always do
    turns: Ints | None = None  # how often each edge draws afresh; 0 for those beyond its end

    def draw(self, n: int) -> Variations:
        """Draw the lots of n knobs."""
        turns = np.zeros(n, np.int64)
        if self.turns is not None:
            turns[: len(self.turns)] = self.turns[:n]
        drawn = np.zeros((4, n))
        for turn in range(int(turns.max(initial=0)) + 1):
            rng = np.random.default_rng([self.seed, self.chart, turn])
            side = np.where(rng.random(n) < 0.5, -1.0, 1.0)
            place = self.random * rng.uniform(-JITTER, JITTER, n)
            lean = self.random * LEAN * rng.uniform(-1, 1, n)
            scale = 1 + self.random * (rng.uniform(SMALLER, LARGER, n) - 1)
            drawn = np.where(turns >= turn, [side, place, lean, scale], drawn)
        return Variations(*drawn)


@dataclass(frozen=True)
class KnobRules:
    """Where the knobs of one chart may be, and how large."""

    inside: Any  # shapely geometry, where knobs may be
    min_neck: float  # mm
    clearance: float  # mm, that knobs keep from edges and from each other
    bend: Callable[[Floats], Floats]  # maps points (..., 2) of the plane; what is drawn is tested after it
    period: float = 0.0  # mm, of a periodic chart
    stretch: Stretch | None = None  # of the chart, for necks to be as wide as asked on the surface
    largest: float = LARGEST  # times its size, that a knob may grow for its neck to be as wide as asked


def choose_knobs(
    ends: Floats,
    sides: Ints,
    template: Template,
    rules: KnobRules,
    chances: Chances,
    open_to: Bools | None = None,
) -> tuple[Bools, Floats]:
    """Draw edges with a knob each, where one fits.

    A knob changes its side, its place and its scale to lie inside the chart, clear of other edges and
    knobs, but shrinks to no thinner neck than the least; where none fits, the edge is plain.

    Parameters
    ----------
    ends : (e, 2, 2) float64, mm, before they are bent
    sides : (e,) int64, 1: knob to the left first, -1: to the right first, 0: to either
    template : Template
    rules : KnobRules
    chances : Chances
    open_to : (e,) bool, optional, edges that may have a knob; all of them if not given

    Returns
    -------
    chosen : (e,) bool, edges with a knob
    curves : (e, n, 2) float64, mm, bent
    """
    import shapely

    n = len(ends)
    vary = chances.draw(n)
    first_side = np.where(sides == 0, vary.side, sides)
    jitter = vary.place * (sides == 0)
    straight = np.stack([np.linspace(0, 1, len(template.points)), np.zeros(len(template.points))], 1)
    curves = rules.bend(along(straight, ends))
    need = STRETCH * rules.min_neck / (template.neck_width * _length_at_middle(curves, rules.stretch))
    least = np.minimum(need, 1.0)
    full = np.maximum(vary.scale, np.minimum(need, rules.largest))

    chosen = np.zeros(n, bool)
    around = surroundings(curves, rules.clearance, rules.period)
    knob = slice(template.neck[0], template.neck[1] + 1)
    open_edges, middle = _free_middles(rules.inside, curves[:, [0, -1]])
    if open_to is not None:
        open_edges = open_edges & open_to
    for before, factor, place, side in _TRIES:
        todo = np.flatnonzero(~chosen & open_edges & (before * full > least))
        if not len(todo):
            continue
        scale = np.maximum(factor * full, least)[todo]
        room = np.minimum(FARTHEST, 0.48 - max(0.2, template.reach) * scale)
        at = middle[todo] if place is None else np.full(len(todo), place)
        at = np.clip(at + jitter[todo], -room, room)
        shape = _shaped(template, side * first_side[todo], at, scale, vary.lean[todo])
        tried = rules.bend(along(shape, ends[todo]))
        fits = shapely.contains_properly(rules.inside, shapely.linestrings(tried[:, knob]))
        fits &= _is_sound(tried, template)
        todo, tried = todo[fits], tried[fits]
        clear = ~around.hit(tried, todo, curves, chosen, knob)
        curves[todo[clear]] = tried[clear]
        chosen[todo[clear]] = True
    return chosen, curves


def _length_at_middle(curves: Floats, stretch: Stretch | None) -> Floats:
    """How long straight edges (e, n, 2) would be, bent all along as they are in the middle; (e,), mm."""
    n = curves.shape[1] - 1
    a, b = int(0.4 * n), n - int(0.4 * n)
    ahead = curves[:, b] - curves[:, a]
    length: Floats = np.linalg.norm(ahead, axis=1) * n / (b - a)
    return length if stretch is None else length * stretch((curves[:, a] + curves[:, b]) / 2, ahead)


def _free_middles(inside: Any, ends: Floats) -> tuple[Bools, Floats]:
    """Tell which edges run inside a chart, and where the middle of that part is, -1/2 to 1/2."""
    import shapely

    lines = shapely.linestrings(ends)
    touches = shapely.intersects(inside, lines)
    middle = np.zeros(len(ends))
    cut = np.flatnonzero(touches & ~shapely.contains_properly(inside, lines))
    parts, of_line = shapely.get_parts(shapely.intersection(inside, lines[cut]), return_index=True)
    longest = np.lexsort((shapely.length(parts), of_line))  # the last of each line
    of_line, parts = of_line[longest], parts[longest]
    last = np.append(of_line[1:] != of_line[:-1], True)[: len(of_line)]
    line = cut[of_line[last]]
    xy = shapely.get_coordinates(shapely.line_interpolate_point(parts[last], 0.5, normalized=True))
    d = ends[line, 1] - ends[line, 0]
    along_it = np.einsum("ij,ij->i", xy - ends[line, 0], d) / np.einsum("ij,ij->i", d, d)
    middle[line] = along_it - 0.5
    return touches, middle


def _shaped(template: Template, side: Floats, place: Floats, scale: Floats, lean: Floats) -> Floats:
    """Move, scale, lean and mirror a template's knob while its ends stay, (e, n, 2)."""
    x, y = template.points[:, 0] - 0.5, template.points[:, 1] * scale[:, None]
    reach = max(0.2, template.reach)  # half of what is moved as a whole
    end = np.where(x < 0, -0.5, 0.5)
    outer = np.clip((x - end) / (np.sign(x) * reach - end + (x == 0)), 0, 1)
    edge = np.sign(x) * reach * scale[:, None] + place[:, None]
    moved = np.where(np.abs(x) <= reach, x * scale[:, None] + place[:, None], end + outer * (edge - end))
    return np.stack([moved + 0.5 + lean[:, None] * np.maximum(y, 0.0), side[:, None] * y], -1)


def _is_sound(curves: Floats, template: Template) -> Bools:
    """Tell which knobs still have a head clearly wider than their neck."""
    head, neck = (
        np.linalg.norm(curves[:, a] - curves[:, b], axis=1) for a, b in (template.head, template.neck)
    )
    return head >= LEAST_HEAD * neck
