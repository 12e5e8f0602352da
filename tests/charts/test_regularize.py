import numpy as np
import pytest

from meshjig.charts.regularize import denoise, regularize
from meshjig.errors import ChartError
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.mesh.mesh import Mesh
from tests.meshes import creased_box, cylinder, disc, genus2, noisy, open_cup, saddle, sphere, torus


def test_regularizing_moves_thin_faces_only_and_by_little():
    V, F = sphere(500)
    mesh = Mesh(V, F)
    assert regularize(mesh) is mesh
    V[F[100, 0]] = V[F[100, 1]]
    moved = regularize(Mesh(V, F)).V
    assert face_areas(moved, F).min() > 0
    shift = np.linalg.norm(moved - V, axis=1)
    thin = np.unique(F[face_areas(V, F) == 0])
    assert set(np.flatnonzero(shift)) == set(thin)
    assert shift.max() < 0.1
    with pytest.raises(ChartError, match="no extent"):
        regularize(Mesh(np.zeros_like(V), F))


def test_noise_is_smoothed_away_on_top_of_that():
    V, F = noisy(sphere(20000), 0.25)
    assert np.linalg.norm(regularize(Mesh(V, F)).V, axis=1).std() < 0.4 * np.linalg.norm(V, axis=1).std()


@pytest.mark.parametrize("maker", [sphere, torus, genus2, creased_box, open_cup, cylinder, saddle])
@pytest.mark.parametrize("amount", [0.0, 0.05])
def test_a_surface_with_little_noise_stays_as_it_is(maker, amount):
    mesh = noisy(maker(3000), amount)
    assert denoise(Mesh(*mesh)).V is mesh.V


@pytest.mark.parametrize("amount", [0.25, 0.4])
def test_noise_goes_and_the_shape_stays(amount):
    clean = sphere(20000)
    mesh = noisy(clean, amount)
    radius = np.linalg.norm(denoise(Mesh(*mesh)).V, axis=1)
    assert radius.std() < 0.4 * np.linalg.norm(mesh.V, axis=1).std()
    assert radius.mean() == pytest.approx(50, abs=0.1)


def test_vertices_hardly_move_sideways_and_a_border_not_at_all():
    mesh = noisy(disc(6000), 0.25)
    V = denoise(Mesh(*mesh)).V
    sideways = np.linalg.norm((V - mesh.V)[:, :2], axis=1)
    assert np.median(sideways) < 0.2 * np.median(np.abs(V - mesh.V)[:, 2])
    rim = mesh.F.ravel()[border_halfedges(mesh.F)]
    assert (V[rim] == mesh.V[rim]).all()
    assert singular_values(V, mesh.F, V[:, :2])[:, 1].min() > 0
