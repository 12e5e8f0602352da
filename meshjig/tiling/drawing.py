"""A net whose edges are drawn: by curves of their own, or with knobs."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, ragged, ranks, row_of, starts
from meshjig.tiling.knobs import Chances, KnobRules, choose_knobs
from meshjig.tiling.net import Placing, TileNet, rounded
from meshjig.tiling.template import Template
from meshjig.tiling.unit import Unit

__all__ = ["Drawing", "EdgeCurves", "draw_knobs", "draw_shapes", "fine_template"]

POINT_DISTANCE = 0.6  # mm along a tile's edge
FLAT = 0.02  # mm, that a drawn curve may be off when it is cut with fewer points
PARTS = 5  # cubics or sides that a knob's edge is drawn with
LONGER = 1.7  # times as long as a straight edge is one with a knob


@dataclass(frozen=True)
class EdgeCurves:
    """Polylines of any number of points each."""

    points: Floats  # (k, 2), mm, curve after curve, both ends included
    start: Ints  # (e + 1,), where each curve begins in points, and where the last one ends

    @property
    def count(self) -> Ints:
        """The number of points of every curve, (e,)."""
        return np.diff(self.start)


@dataclass(frozen=True)
class Drawing:
    """A net whose edges are drawn."""

    net: TileNet
    nodes: Floats  # (n, 2), mm, where the net's nodes have come to lie
    edges: Ints  # (k,), the net's first edges, which are drawn
    curves: EdgeCurves  # of those
    knobbed: Bools  # (k,), those with a knob
    template: Template | None
    period: float


def draw_shapes(net: TileNet, unit: Unit, placing: Placing, bend: Callable[[Floats], Floats]) -> Drawing:
    """Draw edges that interlock by their shape, with a point at least every 0.6 mm before they are bent.

    Parameters
    ----------
    net : TileNet, of the unit
    unit : Unit, with curves
    placing : Placing
    bend : callable, maps points (..., 2) of the chart's plane
    """
    edges = np.unique(net.first_edge)
    drawn = [_refined(curve, placing) for curve in unit.curves or ()]
    size = np.array([len(curve) for curve in drawn])
    kind = net.kind[edges]
    moved = np.repeat(net.copy[edges] @ unit.translations @ placing.matrix, size[kind], axis=0)
    at = ragged(starts(size)[kind], size[kind])
    points = bend(placing(np.concatenate(drawn))[at] + moved)
    curves = EdgeCurves(rounded(points), np.concatenate([[0], np.cumsum(size[kind])]))
    knobbed = np.zeros(len(edges), bool)
    return Drawing(net, _bent_nodes(net, bend), edges, curves, knobbed, None, placing.period)


def draw_knobs(net: TileNet, unit: Unit, template: Template, rules: KnobRules, chances: Chances) -> Drawing:
    """Draw straight edges, with a knob each where one fits.

    Parameters
    ----------
    net : TileNet, of the unit
    unit : Unit, without curves
    template : Template, its knob
    rules : KnobRules
    chances : Chances
    """
    edges = np.unique(net.first_edge)
    sides: Ints = np.zeros(len(unit.ends), np.int64) if unit.knob_side is None else unit.knob_side
    knobbed, drawn = choose_knobs(
        net.nodes[net.ends[edges]], sides[net.kind[edges]], template, rules, chances
    )
    curves = EdgeCurves(rounded(drawn.reshape(-1, 2)), np.arange(len(edges) + 1) * drawn.shape[1])
    return Drawing(net, _bent_nodes(net, rules.bend), edges, curves, knobbed, template, rules.period)


def fine_template(template: Callable[[int], Template], longest: float, most: int) -> Template:
    """Draw a knob with about a point every 0.6 mm of the longest edge, mm, and so many a part at most."""
    return template(int(np.clip(np.ceil(LONGER * longest / POINT_DISTANCE / PARTS), 4, most)))


def _bent_nodes(net: TileNet, bend: Callable[[Floats], Floats]) -> Floats:
    first = net.first_node
    nodes: Floats = rounded(bend(net.nodes[first])) + net.nodes - net.nodes[first]
    return nodes


def _refined(curve: Floats, placing: Placing) -> Floats:
    """Leave out the points of a placed curve that it hardly bends at, and split its long segments."""
    import shapely

    placed = placing(curve)
    kept = shapely.get_coordinates(
        shapely.simplify(shapely.linestrings(placed), FLAT, preserve_topology=False)
    )
    curve = curve[np.flatnonzero(np.isin(placed @ [1, 1j], kept @ [1, 1j]))]
    length = np.linalg.norm(np.diff(placing(curve), axis=0), axis=1)
    n = np.maximum(np.ceil(length / POINT_DISTANCE).astype(np.int64), 1)
    row = row_of(n)
    t = ranks(n) / n[row]
    return np.vstack([curve[row] + t[:, None] * (curve[row + 1] - curve[row]), curve[-1:]])
