"""A way along edges has a left and a right side."""

import numpy as np
import pytest

from meshjig.charts.tubes.cut_path import halfedges_along, left_corners
from tests.charts.helpers import half_tube
from tests.charts.revolved import pole
from tests.meshes import disc


def test_left_of_a_line_up_a_tube_is_on_its_left():
    V, F = pole()
    way = np.arange(40) * 60 + 7  # up the tube
    left = left_corners(F, way)
    assert set(F[left].tolist()) == set(way.tolist())
    angle = np.arctan2(-V[F].mean(1)[:, 2], V[F].mean(1)[:, 0]) - 2 * np.pi * 7 / 60
    np.testing.assert_array_equal(
        left.any(1) & (angle > 0), False
    )  # seen from outside, angles grow to the right
    touching = np.isin(F, way).any(1)
    np.testing.assert_array_equal(left.any(1)[touching], angle[touching] < 0)


@pytest.mark.parametrize("back", [False, True])
def test_both_sides_together_are_all_corners_on_the_way(back):
    _, F = pole(turn=0.5)
    way = np.array([r * 60 + 30 for r in range(40)])
    way = way[::-1] if back else way
    other = left_corners(F, way[::-1].copy())
    left = left_corners(F, way)
    np.testing.assert_array_equal(left | other, np.isin(F, way))
    assert not (left & other).any()


def test_an_end_inside_has_nothing_on_its_left():
    n = 24
    _, F = half_tube(n)
    inside = np.array([(n + 1) * k + n // 2 for k in range(n // 2)])  # from the border to the middle
    left = left_corners(F, inside)
    assert inside[0] in F[left]
    assert inside[-1] not in F[left]


def test_halfedges_along_a_way_come_from_both_sides():
    _, F = disc(600)
    a, b, _ = F[40]
    h = halfedges_along(F, np.array([a, b]))
    assert len(h) == 2
    assert {tuple(sorted((F.ravel()[x], np.roll(F, -1, 1).ravel()[x]))) for x in h} == {tuple(sorted((a, b)))}
