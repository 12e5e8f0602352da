"""Placings carry a tiling to a chart; bent ones repeat after a period and keep the tiles' area."""

import numpy as np
import pytest

from meshjig.tiling import Placing, squares
from meshjig.tiling.classic import classic
from meshjig.tiling.placing import bent_round
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
