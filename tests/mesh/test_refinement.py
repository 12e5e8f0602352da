"""A refinement tells of every face and vertex where it lies on the mesh that was split."""

import numpy as np
import pytest

from meshjig.mesh.measure import face_areas, interpolate
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.refinement import Refinement, places, unrefined
from meshjig.mesh.subdivide import refine
from tests.meshes import cylinder, disc, sphere

SHAPES = pytest.mark.parametrize(
    "shape", [sphere(200), cylinder(200), disc(50)], ids=["sphere", "tube", "sheet"]
)


def finer(mesh, length, shorter=False):
    fine, parent = refine(mesh, length, shorter=shorter)
    return Refinement(fine, mesh, parent, *places(mesh, fine, parent))


@SHAPES
@pytest.mark.parametrize("shorter", [False, True])
def test_refining_keeps_the_surface(shape, shorter):
    mesh = Mesh(*shape)
    found = finer(mesh, 5.0, shorter)
    e = found.mesh.edges
    assert np.linalg.norm(found.V[e.E[:, 0]] - found.V[e.E[:, 1]], axis=1).max() <= 5.0
    assert e.n_faces.max() == 2
    assert np.bincount(found.parent, found.mesh.areas) == pytest.approx(mesh.areas)
    assert np.abs(found.carry(mesh.V) - found.V).max() < 1e-9
    n, face, bary = len(mesh.V), found.vertex_face, found.vertex_bary
    corner = np.take_along_axis(mesh.F[face[:n]], bary[:n].argmax(1)[:, None], 1)[:, 0]
    assert (corner == np.arange(n)).all()
    assert (bary[:n].max(1) == 1).all()


@SHAPES
def test_two_refinements_are_one(shape):
    mesh = Mesh(*shape)
    first = finer(mesh, 12.0)
    second = finer(first.mesh, 4.0)
    both = first.then(second)
    assert len(both.mesh.F) > len(first.mesh.F) > len(mesh.F)
    np.testing.assert_allclose(both.carry(mesh.V), both.V, atol=1e-9)
    np.testing.assert_allclose(both.carry(mesh.V), second.carry(first.carry(mesh.V)), atol=1e-9)
    assert np.bincount(both.parent, face_areas(both.V, both.F)) == pytest.approx(mesh.areas)
    n = len(mesh.V)
    np.testing.assert_array_equal(both.carry(mesh.V)[:n], mesh.V)


def test_places_of_a_refinement_lie_where_they_did():
    mesh = Mesh(*sphere(300))
    found = finer(mesh, 5.0)
    rng = np.random.default_rng(0)
    face, bary = rng.integers(0, len(found.F), 500), rng.dirichlet([1, 1, 1], 500)
    back, where = found.carry_back(face, bary)
    np.testing.assert_array_equal(back, found.parent[face])
    there = interpolate(found.V, found.F, face, bary)
    np.testing.assert_allclose(interpolate(mesh.V, mesh.F, back, where), there, atol=1e-9)
    assert where.min() >= 0


def test_a_mesh_is_a_refinement_of_itself():
    mesh = Mesh(*cylinder(200))
    same = unrefined(mesh)
    values = np.random.default_rng(0).normal(size=(len(mesh.V), 2))
    np.testing.assert_array_equal(same.carry(values), values)
    np.testing.assert_array_equal(same.parent, np.arange(len(mesh.F)))
