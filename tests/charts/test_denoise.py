import numpy as np
import pytest

from meshjig.charts.denoise import denoise
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import singular_values
from tests.meshes import creased_box, cylinder, disc, genus2, noisy, open_cup, saddle, sphere, torus


@pytest.mark.parametrize("maker", [sphere, torus, genus2, creased_box, open_cup, cylinder, saddle])
@pytest.mark.parametrize("amount", [0.0, 0.05])
def test_a_surface_with_little_noise_stays_as_it_is(maker, amount):
    mesh = noisy(maker(3000), amount)
    assert denoise(*mesh) is mesh.V


@pytest.mark.parametrize("amount", [0.25, 0.4])
def test_noise_goes_and_the_shape_stays(amount):
    clean = sphere(20000)
    mesh = noisy(clean, amount)
    radius = np.linalg.norm(denoise(*mesh), axis=1)
    assert radius.std() < 0.4 * np.linalg.norm(mesh.V, axis=1).std()
    assert radius.mean() == pytest.approx(50, abs=0.1)


def test_vertices_hardly_move_sideways_and_a_border_not_at_all():
    mesh = noisy(disc(6000), 0.25)
    V = denoise(*mesh)
    sideways = np.linalg.norm((V - mesh.V)[:, :2], axis=1)
    assert np.median(sideways) < 0.2 * np.median(np.abs(V - mesh.V)[:, 2])
    rim = mesh.F.ravel()[border_halfedges(mesh.F)]
    assert (V[rim] == mesh.V[rim]).all()
    assert singular_values(V, mesh.F, V[:, :2])[:, 1].min() > 0
