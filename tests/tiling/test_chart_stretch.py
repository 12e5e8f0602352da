"""Lengths along charts tell those on the surface, and necks are as wide there as asked."""

from dataclasses import replace

import numpy as np
import pytest

from meshjig.mesh.types import Mesh
from meshjig.tiling.chart_stretch import chart_stretch
from meshjig.tiling.tiles import tile_charts
from tests.tiling.charts import flat_chart, ring_chart

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
