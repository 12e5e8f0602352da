"""UVs that go around: the line where they were cut is a closing line; what only looks like one is none."""

import numpy as np
import pytest

from meshjig.charts.chart import Chart
from meshjig.charts.file_uv.periodic_islands import closed_around
from meshjig.mesh.halfedges import edges
from tests.charts.helpers import all_turn_left

GIRTH, HEIGHT, AROUND, ROWS = 90.0, 60.0, 45, 30


def strip(turn=0.0, shear=0.0, stretch=None):
    """A tube's faces (rows welded around) and the flat strip that they make, turned and sheared."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(AROUND + 1), np.arange(ROWS + 1), indexing="ij"))
    a = (np.arange(AROUND)[:, None] * (ROWS + 1) + np.arange(ROWS)[None]).ravel()
    b = a + ROWS + 1
    corners = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    F = (corners // (ROWS + 1) % AROUND) * (ROWS + 1) + corners % (ROWS + 1)
    v = j * HEIGHT / ROWS
    u = i * GIRTH / AROUND * (1.0 if stretch is None else 1 + stretch * v / HEIGHT) + shear * v
    c, s = np.cos(turn), np.sin(turn)
    uv = np.stack([u, v], 1) @ np.array([[c, s], [-s, c]])
    return F, Chart(np.arange(len(F)), uv, corners)


def assert_closes(F, chart):
    """All that was cut is closed: edges of the tube with two places in the plane have them a period apart."""
    e = edges(F)
    G, h = chart.corners.ravel(), np.arange(3 * len(F))
    following = np.where(h % 3 == 2, h - 2, h + 1)
    inner = e.twin != h
    apart = chart.uv[G[h]] - chart.uv[G[following[e.twin]]]
    moved = apart[inner & (np.abs(apart).max(1) > 1e-9)]
    assert len(moved) == 2 * ROWS
    np.testing.assert_array_equal(np.abs(moved), np.tile([chart.period, 0.0], (len(moved), 1)))


@pytest.mark.parametrize("turn", [0.0, 0.7, np.pi / 2, 3.0, -2.0])
@pytest.mark.parametrize("shear", [0.0, 0.4])
def test_a_cut_tube_is_closed_whichever_way_it_lies(turn, shear):
    F, cut = strip(turn, shear)
    chart = closed_around(cut, edges(F))
    assert chart.period == pytest.approx(GIRTH, abs=2.0**-8)
    assert_closes(F, chart)
    assert all_turn_left(chart.uv, chart.corners)


def test_a_wavy_cut_is_closed_too():
    F, cut = strip()
    wave = 3 * np.sin(cut.uv[:, 1:] / 7)
    chart = closed_around(Chart(cut.faces, cut.uv + wave * [1.0, 0.0], cut.corners), edges(F))
    assert_closes(F, chart)


def test_a_fan_is_not_closed():
    """A cone's strip whose sides part by a tenth has no one period."""
    F, cut = strip(stretch=0.1)
    assert closed_around(cut, edges(F)) is cut


def test_a_disc_without_cuts_stays_as_it_is():
    _, cut = strip()
    assert closed_around(cut, edges(cut.corners)) is cut


def test_a_strip_whose_sides_bulge_alike_is_closed():
    """One side reaches far over where the next copy's box begins, but fits into its other side."""
    F, cut = strip()
    bulge = 60 * np.sin(np.pi * cut.uv[:, 1:] / HEIGHT) * [1.0, 0.0]
    assert_closes(F, closed_around(Chart(cut.faces, cut.uv + bulge, cut.corners), edges(F)))
