"""A ring cut open: both sides of the line are a period apart, wherever the line runs."""

import numpy as np
import pytest

from meshjig.charts.tubes.cut_annulus import meets_itself, ring_net, settle, unroll
from meshjig.errors import ChartError
from meshjig.mesh.components import is_disc
from tests.charts.helpers import all_turn_left, signed_areas
from tests.charts.revolved import pole

PERIOD = 90.0


def ring(turn=0.4, wave=0.0):
    """Give a tube, and its map written down: angle and height, u counted up to whole periods."""
    V, F = pole(turn)
    u = np.arctan2(-V[:, 2], V[:, 0]) / (2 * np.pi) * PERIOD
    whole = np.random.default_rng(0).integers(-2, 3, len(V)) * PERIOD
    return V, F, np.stack([u + whole, V[:, 1] + wave * np.sin(4 * np.pi * u / PERIOD)], 1)


@pytest.mark.parametrize("around", [None, 0.0, 40.0, 89.0])
def test_a_strip_is_a_disc_whose_sides_fit_exactly(around):
    _, F, uv = ring()
    strip = unroll(ring_net(F), uv, PERIOD, around)
    assert is_disc(strip.corners)
    assert all_turn_left(strip.uv, strip.corners)
    assert signed_areas(strip.uv, strip.corners).sum() == pytest.approx(PERIOD * 90)
    n = len(uv)
    np.testing.assert_array_equal(strip.uv[n:], strip.uv[strip.line] + [PERIOD, 0.0])
    turns = (strip.uv[:n, 0] - uv[:, 0]) / PERIOD
    np.testing.assert_allclose(turns, np.rint(turns), atol=1e-9)
    vertex = np.append(np.arange(n), strip.line)
    np.testing.assert_array_equal(vertex[strip.corners], F)


def test_the_line_runs_straight_up_near_where_it_is_wanted():
    _, F, uv = ring(turn=0.0)
    strip = unroll(ring_net(F), uv, PERIOD, around=31.0)
    place = uv[strip.line, 0] % PERIOD
    assert np.ptp(place) < 1e-9
    assert place[0] == pytest.approx(31.0, abs=1.5)
    assert len(strip.line) == 40


def test_a_sheet_has_no_two_rims():
    _, F, _ = ring()
    with pytest.raises(ChartError, match="two rims"):
        ring_net(F[:1])


def test_a_map_that_does_not_go_around_is_refused():
    _, F, uv = ring()
    flat = np.stack([np.sin(uv[:, 0] * 2 * np.pi / PERIOD), uv[:, 1]], 1)
    with pytest.raises(ChartError, match="go around"):
        unroll(ring_net(F), flat, PERIOD)


@pytest.mark.parametrize("where", [0.0, 20.0, 50.0])
def test_mirrored_faces_are_turned_back_and_the_rest_stays(where):
    V, F, uv = ring()
    net = ring_net(F)
    u = uv[:, 0] % PERIOD
    hit = np.flatnonzero((np.abs(u - where) < 1.0) & (uv[:, 1] > 20) & (uv[:, 1] < 70))[::7]
    broken = uv.copy()
    broken[hit] += [4.0, 1.0]
    strip = unroll(net, broken, PERIOD)
    assert not all_turn_left(strip.uv, strip.corners)
    mended = settle(V, net, broken, PERIOD)
    strip = unroll(net, mended, PERIOD)
    assert all_turn_left(strip.uv, strip.corners)
    off = mended - uv
    off[:, 0] -= PERIOD * np.rint(off[:, 0] / PERIOD)
    assert (np.abs(off).max(1) > 1e-9).mean() < 0.1


def test_rims_may_be_wavy():
    _, F, uv = ring(wave=3.0)
    net = ring_net(F)
    assert not meets_itself(net, unroll(net, uv, PERIOD), PERIOD)


@pytest.mark.parametrize("off", [(0.0, -95.0), (0.7 * PERIOD, 0.0)], ids=["down", "along"])
def test_a_rim_that_crosses_the_other_or_its_copy_is_seen(off):
    _, F, uv = ring()
    net = ring_net(F)
    strip = unroll(net, uv, PERIOD)
    top = int(np.flatnonzero((uv[:, 1] > 89) & (np.abs(strip.uv[: len(uv), 0] % PERIOD - 45) < 1))[0])
    strip.uv[top] += off
    assert meets_itself(net, strip, PERIOD)
