import numpy as np
import pytest

from meshjig.solid.surface_distance import SurfaceDistance
from tests.meshes import creased_box, noisy, sphere


def test_under_a_plane_depth_is_distance():
    V, F = creased_box(3000)
    points = np.random.default_rng(0).uniform(-0.9, 0.9, (300, 3)) * V.max(0)
    depth, distance = SurfaceDistance(V, F).behind_planes(points)
    assert distance == pytest.approx((V.max(0) - np.abs(points)).min(1))
    assert depth == pytest.approx(distance)


@pytest.mark.parametrize("beyond", [[3.0, 1.0, -4.0], [2.0, 5.0, -0.5], [1.0, 1.0, 1.0], [2.0, 0.5, 1.0]])
def test_outside_a_box_depth_is_the_largest_along_an_axis(beyond):
    V, F = creased_box(3000)
    beyond = np.array(beyond)
    point = V.max(0) + beyond
    depth, distance = SurfaceDistance(V, F[:, ::-1]).behind_planes(point[None])
    assert distance == pytest.approx([np.linalg.norm(np.maximum(beyond, 0))])
    assert depth == pytest.approx([beyond.max()])


def test_a_miter_is_no_longer_than_its_cap():
    V, F = creased_box(3000)
    point = V.max(0) + 1.0
    depth, distance = SurfaceDistance(V, F[:, ::-1]).behind_planes(point[None], cap=1.2)
    assert depth == pytest.approx(distance / 1.2)


def test_depth_is_never_over_the_distance():
    V, F = noisy(sphere(3000), 0.5)
    points = 0.95 * V
    depth, distance = SurfaceDistance(V, F).behind_planes(points)
    assert (depth <= distance).all()
    assert (depth >= distance / 2).all()
