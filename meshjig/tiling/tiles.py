"""Tile the charts of an atlas with pieces that interlock."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.types import Atlas, Bools, Floats, Ints, Knobs, Outlines
from meshjig.tiling.chart_stretch import Stretch, chart_stretch
from meshjig.tiling.classic import classic
from meshjig.tiling.domain import chart_periods, chart_polygons, unrolled
from meshjig.tiling.edge_curves import POINT_DISTANCE, Curves, shaped_curves
from meshjig.tiling.families.square import squares
from meshjig.tiling.graph import BESIDE, Drawing, chart_graph, joined
from meshjig.tiling.knobs import CLEAR, Chances, choose_knobs
from meshjig.tiling.net import Net, lay_net, rounded
from meshjig.tiling.placing import Placing, placings_in_the_middle
from meshjig.tiling.poles.caps import Cap, close_pole, drawn_cap
from meshjig.tiling.poles.polar_plan import PoleStyle
from meshjig.tiling.poles.poles import Pole, find_poles
from meshjig.tiling.template import Template
from meshjig.tiling.unit import Unit
from meshjig.tiling.warp import WarpStyle, random_warp

__all__ = ["Tiling", "tile_charts", "tile_surface"]

PARTS = 5  # cubics or sides that a knob's edge is drawn with
LONGER = 1.7  # times as long as a straight edge is one with a knob


class Tiling(NamedTuple):
    """What is to be cut of an atlas."""

    outlines: Outlines
    knobs: Knobs
    capstones: Ints  # (k,), labels of charts that are one tile and stay it
    poles: list[dict[str, Any]]  # how each was closed


def tile_charts(
    atlas: Atlas,
    size: float,
    *,
    unit: Unit | None = None,
    placings: Sequence[Placing] | None = None,
    min_neck: float = 0.0,
    random: float = 0.0,
    random_style: WarpStyle = "bspline",
    seed: int = 0,
    turns: Ints | None = None,
) -> tuple[Outlines, Knobs]:
    """Cover every chart with tiles that interlock.

    An edge gets its knob where the whole knob lies inside the chart: a knob never leaves an open
    border, nor is it cut in two by a seam. It changes its side, place and scale to fit, but shrinks
    to no thinner neck than the least; where none fits, the edge is plain. Edges that interlock by
    their shape are drawn as they are. On a periodic chart the tiling goes on over the closing line.

    Parameters
    ----------
    atlas : Atlas
    size : float, mm, edge of a square as large as the mean tile
    unit : Unit, the tiling; squares with classic knobs if not given
    placings : sequence of Placing, one a chart; if not given, a tile lies in the middle of a chart
    min_neck : float, mm
    random : float, 0 to 1, how far tiles are bent, and knobs vary
    random_style : "bspline", smooth, or "bilinear"
    seed : int
    turns : (e,) int64, how often the knob of an edge, as Knobs.edge counts them, was not to one's liking;
        it is drawn with other chances then

    Returns
    -------
    outlines : Outlines
        Labels are tiles. Coordinates are multiples of 2^-18 mm, so that copies on a periodic chart
        are exact.
    knobs : Knobs
        None where edges interlock by their shape.
    """
    tiling = tile_surface(
        atlas,
        size,
        unit=unit,
        placings=placings,
        min_neck=min_neck,
        random=random,
        random_style=random_style,
        seed=seed,
        turns=turns,
    )
    return tiling.outlines, tiling.knobs


def tile_surface(
    atlas: Atlas,
    size: float,
    *,
    pole: PoleStyle | None = None,
    unit: Unit | None = None,
    placings: Sequence[Placing] | None = None,
    min_neck: float = 0.0,
    random: float = 0.0,
    random_style: WarpStyle = "bspline",
    seed: int = 0,
    turns: Ints | None = None,
) -> Tiling:
    """Cover every chart with tiles, and close the poles beyond rings.

    A cap, which is a chart that lies against one ring chart all around, is divided by wedges, on
    which the ring's last tiles run on to the pole, or holds a capstone; see `plan_pole`. No knob is
    over a pole or near it.

    Parameters
    ----------
    pole : "wedge" or "capstone", optional
        If not given, caps are tiled as other charts are.
    atlas, size, unit, placings, min_neck, random, random_style, seed, turns
        As for `tile_charts`. Edges are counted caps last.

    Returns
    -------
    Tiling
    """
    unit = unit or squares(classic)
    polygons, periods = chart_polygons(atlas), chart_periods(atlas)
    if placings is None:
        placings = placings_in_the_middle(unit, polygons, periods, size)
    rng = np.random.default_rng(seed)
    template = _template(unit, size)
    caps = {one.cap: one for one in find_poles(atlas)} if pole else {}
    order = sorted(range(atlas.n_charts), key=lambda chart: (chart in caps, chart))
    parts: dict[int, tuple[Outlines, Knobs]] = {}
    nets: dict[int, Net] = {}
    n_tiles: dict[int, int] = {}
    first: dict[int, int] = {}  # label of each chart
    n_edges = [0]
    capstones: list[int] = []
    facts: list[dict[str, Any]] = []
    for chart in order:
        polygon, placing = polygons[chart], placings[chart]
        again = None if turns is None else turns[sum(n_edges) :]
        chances = Chances(seed, len(n_edges), random, again)
        first[chart] = sum(n_tiles.values())
        if pole and chart in caps:
            ring = caps[chart].ring
            cap = close_pole(caps[chart], polygon, (nets[ring], parts[ring][0]), size, pole)
            facts.append(_closed(caps[chart], cap))
            if cap is not None:
                ring_label = first[ring] - first[chart]
                parts[chart] = drawn_cap(polygon, cap, ring_label, unit, size, min_neck, chances)
                n_tiles[chart] = cap.net.n_own
                n_edges.append(len(cap.net.ends))
                capstones += [first[chart]] if cap.is_one_piece else []
                continue
        bounds = np.array(polygon.bounds)
        net = lay_net(unit, placing, bounds, size / 2 + BESIDE)
        warp = random_warp(bounds, size, random, random_style, rng, placing.period) if random else None
        stretch = chart_stretch(atlas, chart)
        drawing = _draw(polygon, unit, placing, net, warp or _same, stretch, template, min_neck, chances)
        parts[chart], nets[chart] = chart_graph(polygon, drawing), net
        n_tiles[chart] = net.n_tiles
        n_edges.append(len(drawing.edges))
    outlines, knobs = joined(list(parts.values()), list(n_tiles.values()), n_edges[1:])
    return Tiling(outlines, knobs, np.array(capstones, np.int64), facts)


def _closed(pole: Pole, cap: Cap | None) -> dict[str, Any]:
    """Say how a pole was closed."""
    by, meeting, why = "tiles", 0, "the cap is better tiled like any other chart"
    if cap is not None:
        by, meeting, why = "capstone" if cap.plan.capstone else "wedge", cap.meeting, cap.plan.why
    return {"chart": pole.cap, "ring": pole.ring, "closed_by": by, "meeting": meeting, "why": why}


def _draw(
    polygon: Any,
    unit: Unit,
    placing: Placing,
    net: Net,
    bend: Callable[[Floats], Floats],
    stretch: Stretch,
    template: Template | None,
    min_neck: float,
    chances: Chances,
) -> Drawing:
    """Bend a net and draw its edges."""
    import shapely

    edges = np.unique(net.first_edge)
    if template is None:
        knobbed: Bools = np.zeros(len(edges), bool)
        curves = shaped_curves(unit, placing, net, edges, bend)
    else:
        inside = shapely.buffer(unrolled(polygon, placing.period), -CLEAR * placing.size)
        shapely.prepare(inside)
        sides: Ints = np.zeros(len(unit.ends), np.int64) if unit.knob_side is None else unit.knob_side
        knobbed, drawn = choose_knobs(
            inside,
            net.nodes[net.ends[edges]],
            template,
            sides[net.kind[edges]],
            placing.size,
            min_neck=min_neck,
            chances=chances,
            bend=bend,
            period=placing.period,
            stretch=stretch,
        )
        n = drawn.shape[1]
        curves = Curves(drawn.reshape(-1, 2), np.arange(len(edges) + 1) * n)
    curves = Curves(rounded(curves.points), curves.start)
    first = net.first_node
    nodes = rounded(bend(net.nodes[first])) + net.nodes - net.nodes[first]
    return Drawing(net, nodes, edges, curves, knobbed, template, placing.period)


def _template(unit: Unit, size: float) -> Template | None:
    """Draw the knob with about a point every 0.6 mm of the longest edge."""
    if unit.template is None:
        return None
    ends = unit.corners[unit.ends[..., 0]] + unit.ends[..., 1:] @ unit.translations
    longest = size * float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).max())
    return unit.template(int(np.clip(np.ceil(LONGER * longest / POINT_DISTANCE / PARTS), 4, 80)))


def _same(points: Floats) -> Floats:
    return points
