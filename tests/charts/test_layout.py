import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshjig.charts.layout import lie_along, shelves

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
