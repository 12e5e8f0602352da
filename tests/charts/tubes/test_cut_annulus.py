"""A ring cut open: both sides of the line are a period apart, wherever the line runs."""

import numpy as np
import pytest

from meshjig.charts.tubes.cut_annulus import annulus_of, cut_annulus, meets_itself, untangle_annulus
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
    opened = cut_annulus(annulus_of(F), uv, PERIOD, around)
    assert is_disc(opened.corners)
    assert all_turn_left(opened.uv, opened.corners)
    assert signed_areas(opened.uv, opened.corners).sum() == pytest.approx(PERIOD * 90)
    n = len(uv)
    np.testing.assert_array_equal(opened.uv[n:], opened.uv[opened.line] + [PERIOD, 0.0])
    turns = (opened.uv[:n, 0] - uv[:, 0]) / PERIOD
    np.testing.assert_allclose(turns, np.rint(turns), atol=1e-9)
    vertex = np.append(np.arange(n), opened.line)
    np.testing.assert_array_equal(vertex[opened.corners], F)


def test_the_line_runs_straight_up_near_where_it_is_wanted():
    _, F, uv = ring(turn=0.0)
    opened = cut_annulus(annulus_of(F), uv, PERIOD, around=31.0)
    place = uv[opened.line, 0] % PERIOD
    assert np.ptp(place) < 1e-9
    assert place[0] == pytest.approx(31.0, abs=1.5)
    assert len(opened.line) == 40


def test_a_sheet_has_no_two_rims():
    _, F, _ = ring()
    with pytest.raises(ChartError, match="two rims"):
        annulus_of(F[:1])


def test_a_map_that_does_not_go_around_is_refused():
    _, F, uv = ring()
    flat = np.stack([np.sin(uv[:, 0] * 2 * np.pi / PERIOD), uv[:, 1]], 1)
    with pytest.raises(ChartError, match="go around"):
        cut_annulus(annulus_of(F), flat, PERIOD)


@pytest.mark.parametrize("where", [0.0, 20.0, 50.0])
def test_mirrored_faces_are_turned_back_and_the_rest_stays(where):
    V, F, uv = ring()
    annulus = annulus_of(F)
    u = uv[:, 0] % PERIOD
    hit = np.flatnonzero((np.abs(u - where) < 1.0) & (uv[:, 1] > 20) & (uv[:, 1] < 70))[::7]
    broken = uv.copy()
    broken[hit] += [4.0, 1.0]
    opened = cut_annulus(annulus, broken, PERIOD)
    assert not all_turn_left(opened.uv, opened.corners)
    mended = untangle_annulus(V, annulus, broken, PERIOD)
    opened = cut_annulus(annulus, mended, PERIOD)
    assert all_turn_left(opened.uv, opened.corners)
    off = mended - uv
    off[:, 0] -= PERIOD * np.rint(off[:, 0] / PERIOD)
    assert (np.abs(off).max(1) > 1e-9).mean() < 0.1


def test_rims_may_be_wavy():
    _, F, uv = ring(wave=3.0)
    annulus = annulus_of(F)
    assert not meets_itself(annulus, cut_annulus(annulus, uv, PERIOD), PERIOD)


@pytest.mark.parametrize("off", [(0.0, -95.0), (0.7 * PERIOD, 0.0)], ids=["down", "along"])
def test_a_rim_that_crosses_the_other_or_its_copy_is_seen(off):
    _, F, uv = ring()
    annulus = annulus_of(F)
    opened = cut_annulus(annulus, uv, PERIOD)
    top = int(np.flatnonzero((uv[:, 1] > 89) & (np.abs(opened.uv[: len(uv), 0] % PERIOD - 45) < 1))[0])
    opened.uv[top] += off
    assert meets_itself(annulus, opened, PERIOD)
