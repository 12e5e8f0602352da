"""Tile the charts of an atlas with pieces that interlock."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.types import Atlas, Knobs, Outlines
from meshjig.tiling.domain import chart_periods, chart_polygons, chart_stretch, unrolled
from meshjig.tiling.drawing import draw_knobs, draw_shapes, fine_template
from meshjig.tiling.families.regular import squares
from meshjig.tiling.fit import placings_in_the_middle
from meshjig.tiling.graph import BESIDE, chart_graph, joined
from meshjig.tiling.knobs import CLEAR, Chances, KnobRules
from meshjig.tiling.net import Placing, TileNet, lay_net
from meshjig.tiling.poles.caps import PoleFacts, close_pole, drawn_cap, pole_facts
from meshjig.tiling.poles.plan import PoleStyle
from meshjig.tiling.poles.poles import find_poles
from meshjig.tiling.template import classic
from meshjig.tiling.unit import Unit, edge_ends
from meshjig.tiling.warp import WarpStyle, random_warp

__all__ = ["TileStyle", "Tiling", "tile_charts", "tile_surface"]

POINTS = 80  # of a template, a part


@dataclass(frozen=True)
class TileStyle:
    """How tiles and their knobs are drawn."""

    min_neck: float = 0.0  # mm
    random: float = 0.0  # 0 to 1, how far tiles are bent, and knobs vary
    random_style: WarpStyle = "bspline"
    seed: int = 0
    turns: Ints | None = None  # (e,), how often each edge, as Knobs.edge counts them, draws its knob afresh


class Tiling(NamedTuple):
    """What is to be cut of an atlas."""

    outlines: Outlines
    knobs: Knobs
    capstones: Ints  # (k,), labels of charts that are one tile and stay it
    poles: list[PoleFacts]  # how each was closed


class _Part(NamedTuple):
    """What is cut of one chart."""

    outlines: Outlines
    knobs: Knobs
    n_tiles: int
    n_edges: int


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
    style = TileStyle(min_neck, random, random_style, seed, turns)
    tiling = tile_surface(atlas, size, unit=unit, placings=placings, style=style)
    return tiling.outlines, tiling.knobs


def tile_surface(
    atlas: Atlas,
    size: float,
    *,
    unit: Unit | None = None,
    placings: Sequence[Placing] | None = None,
    pole: PoleStyle | None = None,
    style: TileStyle | None = None,
) -> Tiling:
    """Cover every chart with tiles, and close the poles beyond rings.

    A cap, which is a chart that lies against one ring chart all around, is divided by wedges, on
    which the ring's last tiles run on to the pole, or holds a capstone; see `plan_pole`. No knob is
    over a pole or near it.

    Parameters
    ----------
    atlas, size, unit, placings
        As for `tile_charts`. Edges are counted caps last.
    pole : "wedge" or "capstone", optional
        If not given, caps are tiled as other charts are.
    style : TileStyle

    Returns
    -------
    Tiling
    """
    unit, style = unit or squares(classic), style or TileStyle()
    polygons, periods = chart_polygons(atlas), chart_periods(atlas)
    if placings is None:
        placings = placings_in_the_middle(unit, polygons, periods, size)
    tiler = _Tiler(atlas, size, unit, style)
    caps = {one.cap: one for one in find_poles(atlas)} if pole else {}
    order = sorted(range(atlas.n_charts), key=lambda chart: (chart in caps, chart))
    first: dict[int, int] = {}  # label of each chart
    parts: dict[int, _Part] = {}
    capstones: list[int] = []
    facts: list[PoleFacts] = []
    for chart in order:
        first[chart] = sum(part.n_tiles for part in parts.values())
        chances = tiler.chances([part.n_edges for part in parts.values()])
        if pole and chart in caps:
            ring = caps[chart].ring
            laid = tiler.nets[ring], parts[ring].outlines
            cap = close_pole(caps[chart], polygons[chart], laid, size, pole)
            facts.append(pole_facts(caps[chart], cap))
            if cap is not None:
                ring_label = first[ring] - first[chart]
                outlines, knobs = drawn_cap(cap, ring_label, unit, size, style.min_neck, chances)
                parts[chart] = _Part(outlines, knobs, cap.net.n_own, len(cap.net.ends))
                capstones += [first[chart]] if cap.is_one_piece else []
                continue
        parts[chart] = tiler.tile(chart, polygons[chart], placings[chart], chances)
    outlines, knobs = joined(
        [(part.outlines, part.knobs) for part in parts.values()],
        [part.n_tiles for part in parts.values()],
        [part.n_edges for part in parts.values()],
    )
    return Tiling(outlines, knobs, np.array(capstones, np.int64), facts)


class _Tiler:
    """Draws charts one by one; what it draws by chance depends on those before."""

    def __init__(self, atlas: Atlas, size: float, unit: Unit, style: TileStyle) -> None:
        self.atlas, self.size, self.unit, self.style = atlas, size, unit, style
        self.rng = np.random.default_rng(style.seed)
        self.nets: dict[int, TileNet] = {}
        longest = size * float(np.linalg.norm(np.diff(edge_ends(unit), axis=1), axis=2).max())
        self.template = None if unit.template is None else fine_template(unit.template, longest, POINTS)

    def chances(self, n_edges: list[int]) -> Chances:
        """The chances of the chart that comes after others, by the edges of those."""
        turns = None if self.style.turns is None else self.style.turns[sum(n_edges) :]
        return Chances(self.style.seed, len(n_edges) + 1, self.style.random, turns)

    def tile(self, chart: int, polygon: Any, placing: Placing, chances: Chances) -> _Part:
        """Lay tiles over a chart, bend them, and draw their edges."""
        import shapely

        bounds, style = np.array(polygon.bounds), self.style
        net = lay_net(self.unit, placing, bounds, self.size / 2 + BESIDE)
        self.nets[chart] = net
        warp = None
        if style.random:
            warp = random_warp(bounds, self.size, style.random, style.random_style, self.rng, placing.period)
        bend = warp or _same
        if self.template is None:
            drawing = draw_shapes(net, self.unit, placing, bend)
        else:
            clearance = CLEAR * placing.size
            inside = shapely.buffer(unrolled(polygon, placing.period), -clearance)
            shapely.prepare(inside)
            stretch = chart_stretch(self.atlas, chart)
            rules = KnobRules(inside, style.min_neck, clearance, bend, placing.period, stretch)
            drawing = draw_knobs(net, self.unit, self.template, rules, chances)
        return _Part(*chart_graph(polygon, drawing), net.n_tiles, len(drawing.edges))


def _same(points: Floats) -> Floats:
    return points
