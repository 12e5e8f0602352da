"""Tilings are turned, shifted and bent so that few tiles are clipped; bent ones repeat after a period."""

import numpy as np
import pytest
import shapely

from meshjig.tiling import Fit, Placing, TileShapes, chart_periods, chart_polygons, squares
from meshjig.tiling.fit import bent_round
from meshjig.tiling.template import classic
from tests.tiling.charts import flat_chart, ring_chart
from tests.tiling.units import bricks

UNITS = {"squares": squares(classic), "bricks": bricks()}


def test_there_and_back():
    points = np.random.default_rng(0).normal(size=(20, 2))
    placing = Placing(7.0, 25.0, np.array([3.0, 4.0]), stretch=1.2)
    np.testing.assert_allclose(placing.back(placing(points)), points, atol=1e-12)


def test_angle_turns_counterclockwise_and_size_scales():
    np.testing.assert_allclose(Placing(5.0, 90.0)(np.array([1.0, 0.0])), [0.0, 5.0], atol=1e-12)


@pytest.mark.parametrize("name", sorted(UNITS))
@pytest.mark.parametrize("angle", [0.0, 30.0])
@pytest.mark.parametrize("period", [5.0, 13.0, 40.0, 400.0])
def test_bent_tilings_span_the_period_with_tiles_as_large_as_asked(name, angle, period):
    found = bent_round(UNITS[name], 8.0, period, angle)
    assert found
    for placing in found:
        spanned = np.array(placing.wrap) @ UNITS[name].translations @ placing.matrix
        np.testing.assert_allclose(spanned, [period, 0.0], atol=1e-9)
        assert np.linalg.det(placing.matrix) == pytest.approx(64.0)
        assert placing.period == period


def test_whole_tiles_need_no_bending():
    best = bent_round(UNITS["squares"], 8.0, 48.0)[0]
    assert best.wrap == (6, 0)
    assert best.stretch == pytest.approx(1.0)
    assert best.angle == pytest.approx(0.0)


@pytest.mark.parametrize("period", [10.0, 15.0, 21.0])
def test_no_tile_touches_itself_where_two_fit_around(period):
    for placing in bent_round(UNITS["squares"], 8.0, period):
        assert np.abs(placing.wrap).max() > 1 or period < 2 * 8.0 * np.exp(-0.6)


def fit(atlas, unit, size, angle=None):
    return Fit(chart_polygons(atlas), chart_periods(atlas), TileShapes(unit), size, angle)


def clipped(atlas, unit, placing):
    """Give the areas of tiles inside the chart, in tiles."""
    polygon = chart_polygons(atlas)[0]
    laid = TileShapes(unit).lay(placing, np.array(polygon.bounds), np.zeros((0, 2)))
    area = shapely.area(shapely.intersection(laid.tiles, polygon)) / placing.size**2
    area = np.bincount(laid.of_tile, area)
    return area[area > 1e-3]


def test_a_sheet_of_whole_tiles_is_divided_into_them():
    atlas, unit = flat_chart(size=65.0), squares(classic)
    ((placing,),) = fit(atlas, unit, 13.0).placings(13.0, 1)
    assert placing.angle == 0
    area = clipped(atlas, unit, placing)
    assert (area > 0.95).sum() == 25
    assert area[area <= 0.95].sum() < 0.25
    for line in chart_polygons(atlas)[0].bounds:  # no cut runs along the border
        assert np.abs((placing.origin - line + 6.5) % 13.0 - 6.5).min() > 0.1


@pytest.mark.parametrize("unit", [squares(classic), bricks()], ids=["squares", "bricks"])
@pytest.mark.parametrize("atlas", [flat_chart(corner_cut=True), ring_chart()], ids=["notched", "ring"])
def test_the_place_found_clips_less_than_most(unit, atlas):
    found = fit(atlas, unit, 14.0).placings(14.0, 1)[0][0]
    rng = np.random.default_rng(0)
    small = []
    for _ in range(20):
        moved = type(found)(14.0, found.angle, rng.uniform(0, 30, 2), found.stretch, found.period, found.wrap)
        area = clipped(atlas, unit, moved)
        small.append((area < 1 / 3).sum())
    assert (clipped(atlas, unit, found) < 1 / 3).sum() <= np.quantile(small, 0.3)


def test_a_given_angle_is_kept():
    for places in fit(flat_chart(), bricks(), 13.0, angle=12.5).placings(13.0, 3):
        assert places[0].angle == 12.5


def test_rows_fit_between_the_rims_of_a_ring():
    atlas, unit = ring_chart(160.0, height=64.0, wiggle=4.0), squares(classic)
    ((placing,),) = fit(atlas, unit, 16.0).placings(16.0, 1)
    assert placing.wrap == (10, 0)
    assert len(clipped(atlas, unit, placing)) <= 50
    assert (clipped(atlas, unit, placing) > 0.8).sum() == 40
