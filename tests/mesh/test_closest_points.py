import numpy as np
import pytest

from meshjig.mesh.closest_points import nearest
from tests.meshes import half_sphere, noisy


def test_places_near_a_surface_are_found_on_it():
    W, G = half_sphere(2000)
    rng = np.random.default_rng(0)
    face = rng.integers(len(G), size=300)
    bary = rng.dirichlet([5, 5, 5], 300)
    there = (bary[:, :, None] * W[G[face]]).sum(1)
    found = nearest(there * (1 + 1e-6 * rng.normal(size=(300, 1))), W, G)
    assert (found.face == face).all()
    np.testing.assert_allclose(found.bary, bary, atol=1e-4)
    np.testing.assert_allclose(found.interpolated(G, W[:, :2]), there[:, :2], atol=1e-3)


def test_beyond_a_border_the_plane_of_the_nearest_face_goes_on():
    W = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0]])
    found = nearest(np.array([[4.0, -3, 2]]), W, np.array([[0, 1, 2]]))
    assert found.interpolated(np.array([[0, 1, 2]]), W[:, :2])[0] == pytest.approx([4, -3])


def test_far_away_it_does_not_go_on_for_ever():
    W, G = noisy(half_sphere(2000), 0.1)
    uv = nearest(W[:50] * 1000, W, G).interpolated(G, W[:, :2])
    assert np.abs(uv).max() < 1000
