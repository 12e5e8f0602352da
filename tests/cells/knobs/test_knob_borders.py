"""Borders are found once each, with both sides, as they lie in the planes of both cells."""

import numpy as np
import pytest
import shapely

from meshjig.cells.knobs.knob_borders import cell_borders, places_along
from tests.cells.knobs.knob_sheets import EDGE, hemispheres, rolled, square_cells, waved, waved_flat


@pytest.mark.parametrize("shape", [None, rolled])
def test_squares_meet_in_straight_borders(shape):
    b = cell_borders(square_cells(4, 3, shape=shape))
    assert len(b.sides) == 3 * 3 + 4 * 2
    np.testing.assert_allclose(b.length, EDGE, rtol=1e-3)
    np.testing.assert_allclose(b.mm(), EDGE)
    cells = np.sort(b.cell[b.sides], axis=1)
    assert set(np.diff(cells, axis=1).ravel().tolist()) == {1, 3}
    assert len(np.unique(cells, axis=0)) == len(cells)


def test_sides_run_with_their_cell_on_the_left():
    atlas = square_cells(3, fine=20, shape=waved_flat, plane=waved)
    b = cell_borders(atlas)
    middle = atlas.uv[atlas.F_uv].mean(1)
    centre = np.stack([np.bincount(atlas.chart_of_face, x) for x in middle.T], 1)
    centre /= np.bincount(atlas.chart_of_face)[:, None]
    ends = b.loops[b.span]
    d, to_centre = ends[:, 1] - ends[:, 0], centre[b.cell] - ends[:, 0]
    assert (d[:, 0] * to_centre[:, 1] - d[:, 1] * to_centre[:, 0] > 0).all()


def test_both_sides_of_a_border_are_the_same_curve():
    atlas = square_cells(3, fine=20, shape=waved_flat, plane=waved)
    b = cell_borders(atlas)
    for one, other in b.sides:
        p, q = (b.loops[slice(*(b.span[side] + [0, 1]))] for side in (one, other))
        moved = p - q[::-1]
        np.testing.assert_allclose(moved - moved[0], 0, atol=1e-9)
        assert b.opposite(np.array([one])).tolist() == [other]


def test_a_side_and_the_rest_make_up_the_loop():
    b = cell_borders(square_cells(3))
    rims = shapely.length(b.rims())[b.rim]
    np.testing.assert_allclose(shapely.length(b.lines()) + shapely.length(b.others()), rims)
    np.testing.assert_allclose(rims, 4 * EDGE)


def test_a_closed_border_is_one_border():
    b = cell_borders(hemispheres())
    assert b.sides.tolist() == [[0, 1]]
    assert b.length[0] == pytest.approx(2 * np.pi * 30, rel=1e-2)
    assert shapely.is_empty(b.others()).all()


def test_places_along_a_side_are_on_it():
    b = cell_borders(square_cells(2))
    lines = b.lines()
    for share in (0.0, 0.3, 1.0):
        points = places_along(b, b.along[b.span[:, 0]] + share * b.mm())
        np.testing.assert_allclose(shapely.distance(shapely.points(points), lines), 0, atol=1e-9)
        np.testing.assert_allclose(shapely.line_locate_point(lines, shapely.points(points)), share * EDGE)
