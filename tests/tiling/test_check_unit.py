"""What is no tiling is refused, with the fault named; tiles lock where their border has an undercut."""

from dataclasses import replace

import numpy as np
import pytest

from meshjig.errors import OptionError
from meshjig.tiling.check_unit import check_unit, locked_edges
from meshjig.tiling.families.regular import hexagons, macro, squares
from meshjig.tiling.template import Template, classic, enlarged, moved_knob, rectangular
from meshjig.tiling.unit import edge_curves


def other_side(array, *at):
    array = array.copy()
    array[at] = array[at][..., ::-1, :]
    return array


def with_curves(unit):
    return replace(unit, curves=tuple(edge_curves(unit)), template=None, knob_side=None)


def bent(unit, edge, by):
    curves = list(unit.curves)
    curves[edge] = np.vstack([curves[edge][:1], curves[edge][1:-1] + by, curves[edge][-1:]])
    return replace(unit, curves=tuple(curves))


SQUARE, HEXAGON = squares(classic), hexagons()
BROKEN = {
    "second translation on the right": (replace(SQUARE, translations=np.eye(2)[::-1]), "left of the first"),
    "twice too large": (replace(SQUARE, translations=2 * np.eye(2)), "mean area"),
    "edge with a far end": (
        replace(SQUARE, ends=np.array([[(0, 0, 0), (0, 2, 0)], [(0, 0, 0), (0, 0, 1)]])),
        "tile 0",
    ),
    "edge left out": (
        replace(HEXAGON, ends=HEXAGON.ends[1:], sides=HEXAGON.sides[1:], knob_side=np.zeros(2, int)),
        "tile 0",
    ),
    "sides swapped": (replace(HEXAGON, sides=other_side(HEXAGON.sides, 0)), "tile 0"),
    "unknown corner": (replace(HEXAGON, corners=HEXAGON.corners[:1]), "corner"),
    "tile without edges": (replace(macro(), n_tiles=5, translations=np.sqrt(5) * np.eye(2)), "5 tiles"),
    "both curves and knobs": (replace(SQUARE, curves=with_curves(SQUARE).curves), "either"),
    "neither": (replace(SQUARE, template=None), "either"),
    "one curve too few": (replace(with_curves(SQUARE), curves=with_curves(SQUARE).curves[:1]), "one curve"),
    "curve beside its corner": (
        replace(with_curves(SQUARE), curves=tuple(c + 0.01 for c in with_curves(SQUARE).curves)),
        "edge 0",
    ),
    "curve through another": (bent(with_curves(SQUARE), 0, (-0.47, 0.0)), "cross"),
    "knobs too large for a corner": (squares(lambda n: enlarged(classic(n), 1.9)), "crosses itself"),
    "knobs that meet only on sides other than those drawn": (
        squares(lambda n: Template(moved_knob(classic(n).points, 1.3, 0.7))),
        "edges 0 and 1 cross",
    ),
    "knob that crosses itself": (
        squares(lambda n: Template(np.array([(0, 0), (0.6, 0.2), (0.4, 0.2), (0.6, 0), (0.4, 0), (1, 0)]))),
        "crosses itself",
    ),
}


@pytest.mark.parametrize("fault", sorted(BROKEN))
def test_fault_is_named(fault):
    unit, named = BROKEN[fault]
    with pytest.raises(OptionError, match=named):
        check_unit(unit)


@pytest.mark.parametrize("unit", [SQUARE, HEXAGON, macro(), with_curves(SQUARE), with_curves(macro())])
def test_tilings_pass(unit):
    check_unit(unit)


def tooth(n):
    """A knob as wide at its neck as anywhere."""
    return Template(np.array([(0, 0), (0.4, 0), (0.4, 0.2), (0.6, 0.2), (0.6, 0), (1, 0)], dtype=float))


def split_border():
    """Squares whose upper border is two edges: neither locks alone, both together hold like a dovetail."""
    unit = squares(rectangular)
    along = edge_curves(unit)[0]
    middle = len(along) // 2
    return replace(
        unit,
        corners=np.vstack([unit.corners, along[middle]]),
        ends=np.array([[(0, 0, 0), (1, 0, 0)], [(1, 0, 0), (0, 1, 0)], [(0, 0, 0), (0, 0, 1)]]),
        sides=unit.sides[[0, 0, 1]],
        curves=(along[: middle + 1], along[middle:], np.array([(0.0, 0.0), (0.0, 1.0)])),
        template=None,
        knob_side=None,
    )


@pytest.mark.parametrize("unit", [squares(classic), squares(rectangular), hexagons()])
def test_knobs_with_a_neck_lock(unit):
    assert locked_edges(unit).all()


@pytest.mark.parametrize("template", [tooth, None])
def test_straight_borders_and_teeth_do_not_lock(template):
    unit = replace(squares(classic), template=template)
    assert not locked_edges(unit).any()


def test_edges_between_the_same_two_tiles_lock_together():
    assert locked_edges(split_border()).tolist() == [True, True, False]


def test_direction_of_an_edge_does_not_matter():
    unit = split_border()
    turned = replace(
        unit,
        ends=np.array([unit.ends[0], unit.ends[1][::-1], unit.ends[2]]),
        sides=np.array([unit.sides[0], unit.sides[1][::-1], unit.sides[2]]),
        curves=(unit.curves[0], unit.curves[1][::-1], unit.curves[2]),
    )
    assert locked_edges(turned).tolist() == [True, True, False]
