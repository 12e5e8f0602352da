import igl
import numpy as np
import pytest

from meshjig.charts.transfer.proxy import proxy
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import edges
from meshjig.scan.resolution import decimate
from tests.meshes import cylinder, genus2, half_sphere, noisy, open_cup, sphere, torus


@pytest.mark.parametrize("maker", [sphere, torus, genus2, open_cup, cylinder])
def test_topology_survives_and_the_surface_stays_near(maker):
    V, F = maker(12000)
    W, G = proxy(V, F, 1000)
    assert 900 < len(G) <= 1001
    before, after = edges(F), edges(G)
    assert after.n_faces.max() <= 2
    assert components(G)[0] == 1
    assert len(W) - len(after.E) + len(G) == len(V) - len(before.E) + len(F)
    squared, _, _ = igl.point_mesh_squared_distance(V, W, G)
    assert np.sqrt(squared.max()) < 1.5


def test_a_light_mesh_is_its_own_proxy():
    V, F = sphere(500)
    assert proxy(V, F)[1] is F


def test_noise_is_smoothed_away():
    V, F = noisy(sphere(40000), 0.5)
    W, _ = proxy(V, F, 2000)
    assert np.linalg.norm(W, axis=1).std() < 0.75 * np.linalg.norm(V, axis=1).std()


def test_what_was_simplified_before_makes_no_difference():
    V, F = half_sphere(12000)
    before = proxy(V, F, 1000)
    decimate(*open_cup(12000), 1000)
    for expected, found in zip(before, proxy(V, F, 1000), strict=True):
        np.testing.assert_array_equal(found, expected)
