"""The borders of charts, the regions they enclose, and how long what is drawn there is on the surface."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.types import Mesh
from meshjig.tiling import chart_polygons
from meshjig.tiling.domain import chart_borders, chart_stretch, unrolled
from meshjig.tiling.tiles import tile_charts
from tests.meshes import cylinder, disc, genus2, half_sphere, open_cup, two_components
from tests.tiling.charts import flat_chart, ring_chart


@pytest.mark.parametrize("shape", [disc, half_sphere, open_cup, cylinder, genus2, two_components])
def test_borders_are_the_half_edges_without_a_twin(shape):
    F = shape(2000).F
    np.testing.assert_array_equal(chart_borders(F), border_halfedges(F))


def test_polygon_of_a_chart_is_its_outline():
    square, notched = chart_polygons(flat_chart()), chart_polygons(flat_chart(corner_cut=True))
    assert square[0].area == pytest.approx(100**2)
    assert notched[0].area == pytest.approx(0.75 * 100**2)
    assert len(square) == 1


def test_an_unrolled_chart_is_three_periods_long_in_one_piece():
    polygon = chart_polygons(ring_chart(157.0))[0]
    long = unrolled(polygon, 157.0)
    assert isinstance(long, shapely.Polygon)
    assert not long.interiors
    assert long.area == pytest.approx(3 * polygon.area)
    assert unrolled(polygon, 0.0) is polygon


POINTS = np.random.default_rng(3).uniform(5.0, 95.0, (50, 2))
ASKED = 2.0


def directions(angle):
    return np.tile([np.cos(angle), np.sin(angle)], (len(POINTS), 1))


def widened(atlas, by):
    """The same chart, of a surface so many times as large along x, y, z."""
    return replace(atlas, mesh=Mesh(atlas.mesh.V * by, atlas.mesh.F))


@pytest.mark.parametrize("angle", [0.0, 0.4, np.pi / 2, 2.0])
def test_a_chart_of_a_surface_scaled_along_its_axes_is_stretched_by_as_much(angle):
    stretch = chart_stretch(widened(flat_chart(), [0.7, 1.6, 1.0]), 0)
    expected = np.hypot(0.7 * np.cos(angle), 1.6 * np.sin(angle))
    assert stretch(POINTS, 3.0 * directions(angle)) == pytest.approx(expected)


def test_charts_that_keep_lengths_are_not_stretched_and_go_on_over_their_closing_line():
    ring = widened(ring_chart(), [1.0, 1.0, 1.3])
    stretch = chart_stretch(ring, 0)
    for periods in (-1, 0, 1):
        away = POINTS + np.array([periods * ring.period[0], 0.0])
        assert stretch(away, directions(np.pi / 2)) == pytest.approx(1.3, rel=0.02)
        assert stretch(away, directions(0.0)) == pytest.approx(1.0, rel=0.02)


def test_faces_without_area_in_the_chart_tell_nothing_absurd():
    atlas = flat_chart(n=4)
    stretch = chart_stretch(replace(atlas, uv=atlas.uv * [1.0, 0.0]), 0)
    times = stretch(POINTS, directions(0.3))
    assert (times > 0.4).all()
    assert (times < 2.1).all()


@pytest.mark.parametrize("by", [0.75, 1.0, 1.4])
def test_necks_are_as_wide_on_the_surface_as_asked(by):
    outlines, knobs = tile_charts(widened(flat_chart(), [by, by, by]), 15.0, min_neck=ASKED)
    points = outlines.points[knobs.neck]
    necks = by * np.linalg.norm(points[:, 0] - points[:, 1], axis=1)
    assert len(necks) > 50
    assert np.median(necks) > ASKED  # where there is no room for a wider one, it stays as it is
    if by < 1:  # else wide enough anyhow
        assert necks.max() < 1.2 * ASKED
