"""What is no tiling is refused, with the fault named."""

from dataclasses import replace

import numpy as np
import pytest

from meshjig.errors import OptionError
from meshjig.tiling.check_unit import check_unit
from meshjig.tiling.classic import classic
from meshjig.tiling.enlarge import enlarged, moved_knob
from meshjig.tiling.families.hexagon import hexagons
from meshjig.tiling.families.macro import macro
from meshjig.tiling.families.square import squares
from meshjig.tiling.outline import edge_curves
from meshjig.tiling.template import Template


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
