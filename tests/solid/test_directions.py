import numpy as np
import pytest

from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.smoothing import Smoother
from meshjig.solid.directions import miter_directions, smooth_normals, visible_directions
from tests.meshes import creased_box, noisy, saddle, sphere, torus


def test_miters_of_a_box_reach_the_corners_of_the_smaller_box():
    V, F = creased_box(1200)
    half = np.abs(V).max()
    inner = V - 3.0 * miter_directions(V, F)
    on_crease = (np.abs(np.abs(V) - half) < 1e-9).sum(1) >= 2
    assert np.abs(inner[on_crease]).max() == pytest.approx(half - 3.0, abs=0.12)
    corner = np.argmax(V.sum(1))
    assert inner[corner] == pytest.approx(np.full(3, half - 3.0), abs=0.12)


def test_miters_are_capped():
    V = np.array([[0, 0, 0], [10, 0.2, 0], [10, -0.2, 0], [0, 0, 10.0]])
    F = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    assert np.linalg.norm(miter_directions(V, F, cap=1.5), axis=1).max() <= 1.5 + 1e-12


@pytest.mark.parametrize("mesh", [sphere(2000), noisy(sphere(2000), 0.15)], ids=["smooth", "noisy"])
def test_smooth_normals_of_a_sphere_are_radial(mesh):
    V, F = mesh
    d = smooth_normals(V, F, Smoother(V, F), 6.0)
    assert np.einsum("ij,ij->i", d, unit(V)).min() > 0.98


@pytest.mark.parametrize("mesh", [torus(2000), saddle(1000)], ids=["closed", "open"])
def test_smoothing_keeps_the_integral_and_solves_its_equation(mesh):
    from scipy.sparse import diags
    from scipy.sparse.linalg import spsolve

    smoother = Smoother(*mesh)
    values = np.random.default_rng(1).normal(size=(len(mesh.V), 2))
    smooth = smoother(values, 5.0)
    assert (smoother.mass @ smooth) == pytest.approx(smoother.mass @ values, rel=1e-3, abs=0.1)
    system = (diags(smoother.mass) + 12.5 * smoother.L).tocsc()
    assert smooth == pytest.approx(spsolve(system, smoother.mass[:, None] * values), abs=1e-3)


def test_visible_directions_see_all_faces_where_the_start_does_not():
    V = np.array([[0, 0, 0], [1, 0, -4], [0, 1, -0.2], [-1, 0, -0.2], [0, -1, -0.2]], float)
    F = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])
    normals = unit(area_vectors(V, F))
    start = unit(np.array([[-1.0, 0, 0.3]]))
    assert (normals @ start[0]).min() < 0
    assert (normals @ visible_directions(V, F, np.array([0]), start)[0]).min() > 0.2
