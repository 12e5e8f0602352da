"""Close a pole: draw the cap beyond a ring as wedges or with a capstone."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats
from meshjig.mesh.types import Knobs, Outlines
from meshjig.tiling.drawing import Drawing, EdgeCurves, fine_template
from meshjig.tiling.graph import chart_graph
from meshjig.tiling.knobs import CLEAR, Chances, KnobRules, choose_knobs
from meshjig.tiling.net import TileNet, rounded
from meshjig.tiling.poles.cap_net import around_chart, polar_net
from meshjig.tiling.poles.net import PolarNet
from meshjig.tiling.poles.plan import PolePlan, PoleStyle, plan_pole
from meshjig.tiling.poles.poles import CapBorder, Pole, cap_border
from meshjig.tiling.template import classic
from meshjig.tiling.unit import Unit

__all__ = ["Cap", "PoleFacts", "close_pole", "drawn_cap", "pole_facts"]

SHORTEST_RUN = 0.2  # of a tile's edge: a tile that ends on a cap with less makes no wedge
LARGEST = 2.0  # times its size that a knob may grow: edges around a pole are short
MARGIN = 1.15  # times the least neck in the plane: on the surface it may come out narrower
INSIDE = 0.25  # of a cap's radius, that its pole is at least from its border
TRIES = 6  # each without the knobs that crossed other edges, or had to be too small
POINTS = 40  # of a template, a part


class Cap(NamedTuple):
    """How a pole is closed."""

    polygon: Any  # shapely.Polygon, of the chart
    net: PolarNet
    plan: PolePlan
    meeting: int  # wedges
    depth: float  # mm, of the ring's tiles beside the cap

    @property
    def is_one_piece(self) -> bool:
        """Tell whether the whole chart is the capstone."""
        return self.plan.capstone and len(self.plan.levels) == 1


@dataclass(frozen=True)
class PoleFacts:
    """What the report says of a pole."""

    chart: int  # the cap
    ring: int  # its chart
    closed_by: str
    meeting: int  # wedges that meet at it
    why: str  # not as asked for


def close_pole(
    pole: Pole, polygon: Any, ring: tuple[TileNet, Outlines], size: float, style: PoleStyle
) -> Cap | None:
    """Decide on the tiles of a cap, and lay them.

    Parameters
    ----------
    pole : Pole
    polygon : shapely.Polygon, the cap
    ring : TileNet and Outlines of the ring chart
    size : float, mm, of a tile
    style : "wedge" or "capstone"

    Returns
    -------
    Cap, or None where the cap is best tiled like any other chart
    """
    border = cap_border(pole, ring[1], SHORTEST_RUN * size)
    radius = float(np.sqrt(polygon.area / np.pi)) / size
    depth = _depth(pole, border, ring[0])
    plan = plan_pole(style, radius, depth / size, len(border.tile))
    if plan is None:
        return None
    if plan.capstone and len(plan.levels) == 1:
        return Cap(polygon, around_chart(polygon), plan, 0, depth)
    net = polar_net(polygon, _middle(polygon, pole.tip), border, plan)
    if net is None:
        plan = PolePlan((1.0,), (), True, "the end is not round enough for wedges")
        whole = plan_pole("capstone", radius, 0.0, 0)
        return None if whole is None else Cap(polygon, around_chart(polygon), plan, 0, depth)
    return Cap(polygon, net, plan, 0 if plan.capstone else plan.meeting or len(border.tile), depth)


def pole_facts(pole: Pole, cap: Cap | None) -> PoleFacts:
    """Say how a pole was closed."""
    if cap is None:
        return PoleFacts(pole.cap, pole.ring, "tiles", 0, "the cap is better tiled like any other chart")
    by = "capstone" if cap.plan.capstone else "wedge"
    return PoleFacts(pole.cap, pole.ring, by, cap.meeting, cap.plan.why)


def drawn_cap(
    cap: Cap, ring_label: int, unit: Unit, size: float, min_neck: float, chances: Chances
) -> tuple[Outlines, Knobs]:
    """Draw the edges of a cap, with knobs where they have room and leave no thin places.

    Parameters
    ----------
    cap : Cap
    ring_label : int, what the ring's labels are counted from, as seen from the cap's own
    unit : Unit, whose knob is drawn, or a classic one
    size, min_neck : float, mm
    chances : Chances
    """
    import shapely

    net, open_to = cap.net.net(ring_label)
    ends = net.nodes[net.ends]
    longest = float(np.linalg.norm(np.diff(ends, axis=1), axis=2).max())
    template = fine_template(unit.template or classic, longest, POINTS)
    least, min_neck = min_neck, min_neck * MARGIN
    open_to &= LARGEST * template.neck_width * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) >= min_neck
    inside = shapely.buffer(cap.polygon, -max(CLEAR * size, min_neck - cap.depth))
    shapely.prepare(inside)
    rules = KnobRules(inside, min_neck, max(CLEAR * size, min_neck), cap.net.bend, largest=LARGEST)
    sides = np.zeros(len(ends), np.int64)
    for _ in range(TRIES):
        knobbed, drawn = choose_knobs(ends, sides, template, rules, chances, open_to)
        neck = np.linalg.norm(drawn[:, template.neck[0]] - drawn[:, template.neck[1]], axis=1)
        bad = knobbed & (_crossed(drawn) | (neck < least))
        open_to &= ~bad
        if not bad.any():
            break
    curves = EdgeCurves(rounded(drawn.reshape(-1, 2)), np.arange(len(ends) + 1) * drawn.shape[1])
    drawing = Drawing(net, rounded(net.nodes), net.first_edge, curves, knobbed, template, 0.0)
    return chart_graph(cap.polygon, drawing)


def _crossed(curves: Floats) -> Bools:
    """Tell which edges cross others: where edges meet at a small angle, the foot of a knob may."""
    import shapely

    lines = shapely.linestrings(curves)
    crossed = np.zeros(len(lines), bool)
    crossed[shapely.STRtree(lines).query(lines, predicate="crosses")[0]] = True
    return crossed


def _depth(pole: Pole, border: CapBorder, net: TileNet) -> float:
    """How far the ring's tiles that end on a cap reach away from it, mm: half of them farther."""
    level = float(pole.there[..., 1].mean())
    ahead = np.sign(net.nodes[:, 1].mean() - level)
    depth = []
    for tile in np.unique(border.tile).tolist():
        mine: Bools = (net.left == tile) | (net.right == tile)
        depth.append((ahead * (net.nodes[net.ends[mine], 1] - level)).max())
    return float(np.median(depth)) if depth else 0.0


def _middle(polygon: Any, tip: Floats | None) -> Floats:
    """The place of the pole: the tip, else the middle of the area, else of a disc, if well inside."""
    import shapely

    inside = shapely.buffer(polygon, -INSIDE * np.sqrt(polygon.area / np.pi))
    middle = polygon.centroid
    if tip is not None and inside.contains(shapely.Point(tip)):
        return tip
    if not inside.contains(middle):
        middle = shapely.maximum_inscribed_circle(polygon).interpolate(0)
    return np.array([middle.x, middle.y])
