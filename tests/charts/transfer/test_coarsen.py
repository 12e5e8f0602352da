import igl
import numpy as np
import pytest

from meshjig.charts.transfer.coarsen import coarsen
from meshjig.mesh.components import components, fans
from meshjig.mesh.halfedges import edges
from tests.meshes import creased_box, cylinder, disc, genus2, noisy, open_cup, sphere, torus


@pytest.mark.parametrize("maker", [sphere, torus, genus2, open_cup, cylinder, disc, creased_box])
@pytest.mark.parametrize("amount", [0.0, 0.3])
def test_a_mesh_gets_much_lighter_and_keeps_its_topology_and_shape(maker, amount):
    V, F = noisy(maker(12000), amount)
    W, G = coarsen(V, F)
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
    W, _ = coarsen(V, F)
    assert np.linalg.norm(W, axis=1).std() < 0.8 * np.linalg.norm(V, axis=1).std()


def test_folds_stay_sharp():
    V, F = creased_box(12000)
    W, _ = coarsen(V, F)
    assert np.sqrt(((50 - np.abs(W)) ** 2).min(1).max()) < 0.2


def test_what_can_get_no_lighter_is_none():
    F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    assert coarsen(np.vstack([np.zeros(3), np.eye(3)]), F) is None
