"""Close a pole: draw the cap beyond a ring as wedges or with a capstone."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.types import Bools, Floats, Knobs, Outlines
from meshjig.tiling.classic import classic
from meshjig.tiling.edge_curves import POINT_DISTANCE, Curves
from meshjig.tiling.graph import Drawing, chart_graph
from meshjig.tiling.knobs import CLEAR, Chances, choose_knobs
from meshjig.tiling.net import Net, rounded
from meshjig.tiling.poles.polar_graph import PolarNet, around_chart
from meshjig.tiling.poles.polar_net import polar_net
from meshjig.tiling.poles.polar_plan import PolePlan, PoleStyle, plan_pole
from meshjig.tiling.poles.poles import Pole, Rim, ring_rim
from meshjig.tiling.template import Template
from meshjig.tiling.unit import Unit

__all__ = ["Cap", "close_pole", "drawn_cap"]

SHORTEST_RUN = 0.2  # of a tile's edge: a tile that ends on a cap with less makes no wedge
LARGEST = 2.0  # times its size that a knob may grow: edges around a pole are short
MARGIN = 1.15  # times the least neck in the plane: on the surface it may come out narrower
INSIDE = 0.25  # of a cap's radius, that its pole is at least from its border
TRIES = 6  # each without the knobs that crossed other edges, or had to be too small
POINTS = 40  # of a template, a part


class Cap(NamedTuple):
    """How a pole is closed."""

    net: PolarNet
    plan: PolePlan
    meeting: int  # wedges
    depth: float  # mm, of the ring's tiles beside the cap

    @property
    def is_one_piece(self) -> bool:
        """Tell whether the whole chart is the capstone."""
        return self.plan.capstone and len(self.plan.levels) == 1


def close_pole(
    pole: Pole, polygon: Any, ring: tuple[Net, Outlines], size: float, style: PoleStyle
) -> Cap | None:
    """Decide on the tiles of a cap, and lay them.

    Parameters
    ----------
    pole : Pole
    polygon : shapely.Polygon, the cap
    ring : Net and Outlines of the ring chart
    size : float, mm, of a tile
    style : "wedge" or "capstone"

    Returns
    -------
    Cap, or None where the cap is best tiled like any other chart
    """
    rim = ring_rim(pole, ring[1], SHORTEST_RUN * size)
    radius = float(np.sqrt(polygon.area / np.pi)) / size
    depth = _depth(pole, rim, ring[0])
    plan = plan_pole(style, radius, depth / size, len(rim.tile))
    if plan is None:
        return None
    if plan.capstone and len(plan.levels) == 1:
        return Cap(around_chart(polygon), plan, 0, depth)
    net = polar_net(polygon, _middle(polygon, pole.tip), rim, plan)
    if net is None:
        plan = PolePlan((1.0,), (), True, "the end is not round enough for wedges")
        whole = plan_pole("capstone", radius, 0.0, 0)
        return None if whole is None else Cap(around_chart(polygon), plan, 0, depth)
    return Cap(net, plan, 0 if plan.capstone else plan.meeting or len(rim.tile), depth)


def drawn_cap(
    polygon: Any,
    cap: Cap,
    ring_label: int,
    unit: Unit,
    size: float,
    min_neck: float,
    chances: Chances,
) -> tuple[Outlines, Knobs]:
    """Draw the edges of a cap, with knobs where they have room and leave no thin places.

    Parameters
    ----------
    polygon : shapely.Polygon
    cap : Cap
    ring_label : int, what the ring's labels are counted from, as seen from the cap's own
    unit : Unit
    size, min_neck : float, mm
    chances : Chances
    """
    import shapely

    net, open_to = cap.net.net(ring_label)
    template = _template(unit, net)
    ends = net.nodes[net.ends]
    least, min_neck = min_neck, min_neck * MARGIN
    open_to &= LARGEST * template.neck_width * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) >= min_neck
    inside = shapely.buffer(polygon, -max(CLEAR * size, min_neck - cap.depth))
    shapely.prepare(inside)
    for _ in range(TRIES):
        knobbed, drawn = choose_knobs(
            inside,
            ends,
            template,
            np.zeros(len(ends), np.int64),
            size,
            min_neck=min_neck,
            chances=chances,
            bend=cap.net.bend,
            open_to=open_to,
            clearance=max(CLEAR * size, min_neck),
            largest=LARGEST,
        )
        neck = np.linalg.norm(drawn[:, template.neck[0]] - drawn[:, template.neck[1]], axis=1)
        bad = knobbed & (_crossed(drawn) | (neck < least))
        open_to &= ~bad
        if not bad.any():
            break
    curves = Curves(rounded(drawn.reshape(-1, 2)), np.arange(len(ends) + 1) * drawn.shape[1])
    return chart_graph(
        polygon, Drawing(net, rounded(net.nodes), net.first_edge, curves, knobbed, template, 0.0)
    )


def _crossed(curves: Floats) -> Bools:
    """Tell which edges cross others: where edges meet at a small angle, the foot of a knob may."""
    import shapely

    lines = shapely.linestrings(curves)
    crossed = np.zeros(len(lines), bool)
    crossed[shapely.STRtree(lines).query(lines, predicate="crosses")[0]] = True
    return crossed


def _depth(pole: Pole, rim: Rim, net: Net) -> float:
    """Give how far the ring's tiles that end on a cap reach away from it, mm: half of them farther."""
    level = float(pole.there[..., 1].mean())
    ahead = np.sign(net.nodes[:, 1].mean() - level)
    depth = []
    for tile in np.unique(rim.tile).tolist():
        mine: Bools = (net.left == tile) | (net.right == tile)
        depth.append((ahead * (net.nodes[net.ends[mine], 1] - level)).max())
    return float(np.median(depth)) if depth else 0.0


def _middle(polygon: Any, tip: Floats | None) -> Floats:
    """Give the place of the pole: the tip, else the middle of the area, else of a disc, if well inside."""
    import shapely

    inside = shapely.buffer(polygon, -INSIDE * np.sqrt(polygon.area / np.pi))
    middle = polygon.centroid
    if tip is not None and inside.contains(shapely.Point(tip)):
        return tip
    if not inside.contains(middle):
        middle = shapely.maximum_inscribed_circle(polygon).interpolate(0)
    return np.array([middle.x, middle.y])


def _template(unit: Unit, net: Net) -> Template:
    """Draw the unit's knob, or a classic one, with a point about every 0.6 mm of the longest edge."""
    longest = float(np.linalg.norm(np.diff(net.nodes[net.ends], axis=1), axis=2).max())
    n = int(np.clip(np.ceil(1.7 * longest / POINT_DISTANCE / 5), 4, POINTS))
    return (unit.template or classic)(n)
