"""Paths around tiles: they begin at the first corner, with the tile on their left; others are refused."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from meshjig.tiling.families.regular import hexagons, macro, squares
from meshjig.tiling.template import classic
from meshjig.tiling.unit import edge_curves, edge_ends, knob_sides, tile_outlines, tile_steps
from tests.tiling.units import bricks, waves

UNITS = {
    "squares": squares(classic),
    "hexagons": hexagons(),
    "macro": macro(),
    "bricks": bricks(),
    "waves": waves(),
}
SQUARE = UNITS["squares"]


@pytest.mark.parametrize("name", sorted(UNITS))
def test_each_step_starts_where_the_one_before_stops_and_all_edges_are_walked_on_both_sides(name):
    unit = UNITS[name]
    ends = edge_ends(unit)
    walked = []
    for steps in tile_steps(unit):
        path = [
            ends[step.edge][:: 1 if step.forward else -1] + np.array(step.shift) @ unit.translations
            for step in steps
        ]
        for before, after in zip(path, path[1:] + path[:1], strict=True):
            np.testing.assert_allclose(before[1], after[0], atol=1e-12)
        walked += [(step.edge, step.forward) for step in steps]
    assert sorted(walked) == [(edge, forward) for edge in range(len(ends)) for forward in (False, True)]


@pytest.mark.parametrize("name", sorted(UNITS))
def test_outlines_run_counterclockwise_and_enclose_one_tile_each_on_average(name):
    unit = UNITS[name]
    outlines = [shapely.LinearRing(outline) for outline in tile_outlines(unit, edge_curves(unit))]
    assert all(outline.is_ccw for outline in outlines)
    assert sum(shapely.Polygon(outline).area for outline in outlines) == pytest.approx(unit.n_tiles)


def test_a_path_begins_at_the_lowest_corner():
    (steps,) = tile_steps(SQUARE)
    assert [(step.edge, step.forward, step.shift) for step in steps] == [
        (0, True, (0, 0)),
        (1, True, (1, 0)),
        (0, False, (0, 1)),
        (1, False, (0, 0)),
    ]


@pytest.mark.parametrize(
    ("unit", "message"),
    [
        (replace(SQUARE, n_tiles=2), "tile 1 has no edge"),
        (replace(SQUARE, ends=SQUARE.ends[[0, 0]]), "comes twice through corner 0"),
        (replace(SQUARE, ends=SQUARE.ends[:1], sides=SQUARE.sides[:1]), "not one closed loop"),
    ],
)
def test_edges_that_are_no_single_path_are_refused(unit, message):
    with pytest.raises(ValueError, match=message):
        tile_steps(unit)


def test_knobs_alternate_where_either_side_will_do():
    assert knob_sides(hexagons()).tolist() == [1, -1, 1]
    assert knob_sides(macro()).tolist() == macro().knob_side.tolist()
