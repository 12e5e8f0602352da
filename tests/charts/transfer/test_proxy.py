import igl
import numpy as np
import pytest

from meshjig.charts.transfer.proxy import coarsen, proxy_mesh
from meshjig.mesh.components import components, fans
from meshjig.mesh.halfedges import edges
from meshjig.mesh.mesh import Mesh
from meshjig.scan.scale import decimate
from tests.meshes import creased_box, cylinder, disc, genus2, half_sphere, noisy, open_cup, sphere, torus


@pytest.mark.parametrize("maker", [sphere, torus, genus2, open_cup, cylinder])
def test_topology_survives_and_the_surface_stays_near(maker):
    V, F = maker(12000)
    W, G = proxy_mesh(Mesh(V, F), 1000)
    assert 900 < len(G) <= 1001
    before, after = edges(F), edges(G)
    assert after.n_faces.max() <= 2
    assert components(G)[0] == 1
    assert len(W) - len(after.E) + len(G) == len(V) - len(before.E) + len(F)
    squared, _, _ = igl.point_mesh_squared_distance(V, W, G)
    assert np.sqrt(squared.max()) < 1.5


def test_a_light_mesh_is_its_own_proxy():
    V, F = sphere(500)
    mesh = Mesh(V, F)
    assert proxy_mesh(mesh) is mesh


def test_noise_is_smoothed_away():
    V, F = noisy(sphere(40000), 0.5)
    W, _ = proxy_mesh(Mesh(V, F), 2000)
    assert np.linalg.norm(W, axis=1).std() < 0.75 * np.linalg.norm(V, axis=1).std()


def test_what_was_simplified_before_makes_no_difference():
    V, F = half_sphere(12000)
    before = proxy_mesh(Mesh(V, F), 1000)
    decimate(*open_cup(12000), 1000)
    for expected, found in zip(before, proxy_mesh(Mesh(V, F), 1000), strict=True):
        np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("maker", [sphere, torus, genus2, open_cup, cylinder, disc, creased_box])
@pytest.mark.parametrize("amount", [0.0, 0.3])
def test_a_mesh_gets_much_lighter_and_keeps_its_topology_and_shape(maker, amount):
    V, F = noisy(maker(12000), amount)
    W, G = coarsen(Mesh(V, F))
    assert 0.15 * len(F) < len(G) < 0.5 * len(F)
    before, after = edges(F), edges(G)
    assert after.n_faces.max() <= 2
    assert len(fans(G)[1]) == len(W)
    assert components(G)[0] == 1
    assert len(W) - len(after.E) + len(G) == len(V) - len(before.E) + len(F)
    squared, _, _ = igl.point_mesh_squared_distance(V, W, G)
    edge = np.linalg.norm(V[before.E[:, 0]] - V[before.E[:, 1]], axis=1).mean()
    assert np.sqrt(squared.max()) < (1.0 + 1.5 * amount) * edge


def test_noise_is_averaged_out():
    V, F = noisy(sphere(20000), 0.25)
    W, _ = coarsen(Mesh(V, F))
    assert np.linalg.norm(W, axis=1).std() < 0.8 * np.linalg.norm(V, axis=1).std()


def test_folds_stay_sharp():
    V, F = creased_box(12000)
    W, _ = coarsen(Mesh(V, F))
    assert np.sqrt(((50 - np.abs(W)) ** 2).min(1).max()) < 0.2


def test_what_can_get_no_lighter_is_none():
    F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    assert coarsen(Mesh(np.vstack([np.zeros(3), np.eye(3)]), F)) is None
