import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshjig.charts.chart import Chart, lay_out, lie_along, shelves
from meshjig.mesh.types import Mesh

sides = st.floats(0.5, 200)


@given(st.lists(st.tuples(sides, sides), min_size=1, max_size=40), st.floats(0, 20))
def test_boxes_keep_their_margin(boxes, margin):
    size = np.array(boxes)
    low = shelves(size, margin)
    high = low + size
    gap = np.maximum(low[:, None] - high[None], low[None] - high[:, None]).max(2)
    np.fill_diagonal(gap, np.inf)
    assert gap.min() >= margin - 1e-9
    assert low.min() >= 0


def test_many_equal_boxes_make_about_a_square():
    size = np.full((60, 2), [30.0, 10.0])
    extent = (shelves(size) + size).max(0)
    assert extent.max() / extent.min() < 1.4
    assert (size + 5).prod(1).sum() / extent.prod() > 0.75


@given(st.floats(0, 360))
def test_a_long_chart_is_turned_along_u_and_not_mirrored(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    flag = np.array([[0.0, 0], [40, 0], [40, 10], [20, 5], [0, 10]])
    turned = lie_along(flag @ np.array([[c, s], [-s, c]]) + 7)
    np.testing.assert_allclose(turned.min(0), 0, atol=1e-9)
    np.testing.assert_allclose(turned.max(0), [40, 10], atol=1e-9)
    x, y = turned[[1, 2]] - turned[0]
    assert x[0] * y[1] - x[1] * y[0] > 0


def strip(width, height, turned=0.0):
    """Two faces of a rectangle."""
    corners = np.array([[0.0, 0], [width, 0], [width, height], [0, height]])
    c, s = np.cos(turned), np.sin(turned)
    return corners @ np.array([[c, s], [-s, c]]) - 3.7, np.array([[0, 1, 2], [0, 2, 3]])


@given(st.floats(3, 40), st.floats(3, 40), st.floats(0, 6))
def test_charts_of_an_atlas_lie_apart_and_a_ring_keeps_its_direction_and_period(width, height, turned):
    (ring, F), (plain, _), period = strip(7.25, height), strip(width, 9.0, turned), 7.25
    ring = np.rint(ring * 2**18) / 2**18
    V = np.zeros((8, 3))
    mesh = Mesh(V, np.concatenate([F, F + 4]))
    charts = [Chart(np.array([0, 1]), plain, F), Chart(np.array([2, 3]), ring, F, period)]
    atlas = lay_out(mesh, charts, 2.0)
    assert sorted(atlas.period) == [0, period]
    laid = atlas.uv[atlas.F_uv[2:]].reshape(-1, 2)
    other = atlas.uv[atlas.F_uv[:2]].reshape(-1, 2)
    assert (laid * 2**18 == np.rint(laid * 2**18)).all()
    place = {tuple(row) for row in laid}
    assert {(u + period, v) for u, v in place if (u + period, v) in place} | {
        (u, v) for u, v in place if (u + period, v) in place
    } == place
    gap = np.maximum(laid.min(0) - other.max(0), other.min(0) - laid.max(0)).max()
    assert gap >= 2 - 1e-9


def test_without_rings_there_are_no_periods():
    uv, F = strip(4, 5)
    assert lay_out(Mesh(np.zeros((4, 3)), F), [Chart(np.arange(2), uv, F)]).period is None
