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


def test_points_move_to_a_depth_or_up_to_a_tenth_more():
    V, F = sphere(4000)
    radius = np.linalg.norm(V, axis=1).mean()
    way = V[::7] / np.linalg.norm(V[::7], axis=1)[:, None]
    for height, depth in (
        (-0.5, 2.0),
        (-1e-4, 2.0),
        (0.5, 2.0),
        (-2.1, 2.1),
        (-3.0, 2.2),
    ):  # 0.5: in front of the surface
        P = SurfaceDistance(V, F).to_depth((radius + height) * way, np.full(len(way), 2.0), 1.0, 5.0)
        assert radius - np.linalg.norm(P, axis=1) == pytest.approx(depth, abs=0.05)


def test_points_move_by_a_share_of_what_they_lack_up_to_a_limit():
    V, F = creased_box(600)
    P = np.array([[0.0, 0.0, V[:, 2].max() - 1.0]])
    surface = SurfaceDistance(V, F)
    assert (P - surface.to_depth(P, np.array([3.0]), 0.5, 9.0))[0] == pytest.approx([0, 0, 1.0])
    assert (P - surface.to_depth(P, np.array([3.0]), 0.5, 1.0))[0] == pytest.approx([0, 0, 0.5])
