"""Tiles hold on to each other where their border has an undercut, and nowhere else."""

from dataclasses import replace

import numpy as np
import pytest

from meshjig.tiling.classic import classic
from meshjig.tiling.families.hexagon import hexagons
from meshjig.tiling.families.square import squares
from meshjig.tiling.locked_edges import locked_edges
from meshjig.tiling.outline import edge_curves
from meshjig.tiling.rectangular import rectangular
from meshjig.tiling.template import Template


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
