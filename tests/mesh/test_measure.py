"""Measures of shapes that are known."""

import numpy as np
import pytest

from meshjig.mesh.measure import (
    angle_normals,
    area_vectors,
    barycentric,
    edge_lengths,
    face_areas,
    interpolate,
    mesh_volume,
    prism_volumes,
    signed_area,
    singular_values,
    sums,
    unit,
    vertex_normals,
)
from tests.check.pieces import box
from tests.meshes import sphere

V = np.array([[0.0, 0, 0], [4, 0, 0], [0, 3, 0]])
F = np.array([[0, 1, 2]])


def test_a_right_triangle():
    assert face_areas(V, F).tolist() == [6.0]
    assert area_vectors(V, F).tolist() == [[0.0, 0.0, 12.0]]
    assert edge_lengths(V, np.array([[0, 1], [1, 2]])).tolist() == [4.0, 5.0]
    assert face_areas(V[:, :2], F[:, ::-1]).tolist() == [-6.0]  # in the plane it has a sign


def test_the_area_and_the_volume_of_a_sphere():
    ball = sphere(20_000)
    assert face_areas(*ball).sum() == pytest.approx(4 * np.pi * 50**2, rel=1e-3)
    assert mesh_volume(*ball) == pytest.approx(4 / 3 * np.pi * 50**3, rel=2e-3)
    assert mesh_volume(ball.V, ball.F[:, ::-1]) == pytest.approx(-mesh_volume(*ball))
    np.testing.assert_allclose(vertex_normals(*ball), ball.V / 50, atol=0.02)


@pytest.mark.parametrize("high", [10.0, 0.1])
def test_normals_by_angle_don_t_depend_on_how_large_faces_are(high):
    slab = box([0, 0, 0], [10, 10, high], n=2)
    inward = np.sign([5, 5, high / 2] - slab.V) * (np.abs(slab.V / [5, 5, high / 2] - 1) > 1e-9)
    np.testing.assert_allclose(angle_normals(*slab), -unit(inward), atol=1e-9)


def test_the_volume_below_faces_is_that_between_two_sheets_however_slanted():
    below = prism_volumes(V, np.tile([0.0, 0, -2.0], (3, 1)), F)
    assert below == pytest.approx([12.0])
    assert prism_volumes(V, np.tile([1.0, 3.0, -2.0], (3, 1)), F) == pytest.approx(below)
    assert prism_volumes(V, np.tile([0.0, 0, 2.0], (3, 1)), F) == pytest.approx(-below)
    assert prism_volumes(V, np.array([[0.0, 0, 0], [0, 0, 0], [0, 0, -3.0]]), F) == pytest.approx([6.0])
    ball = sphere(2000)
    whole = mesh_volume(*ball) - mesh_volume(0.9 * ball.V, ball.F)
    assert prism_volumes(ball.V, -0.1 * ball.V, ball.F).sum() == pytest.approx(whole)


def test_barycentric_coordinates_lead_back_to_the_point():
    rng = np.random.default_rng(0)
    W, G = rng.normal(size=(9, 3)), rng.permutation(9).reshape(3, 3)
    bary = rng.dirichlet([1, 1, 1], 50)
    face = rng.integers(0, 3, 50)
    found = barycentric(W, G, face, interpolate(W, G, face, bary))
    np.testing.assert_allclose(found, bary, atol=1e-9)
    flat = barycentric(np.zeros((3, 3)), F, np.array([0]), np.ones((1, 3)))
    assert flat.tolist() == [[1.0, 0.0, 0.0]]


@pytest.mark.parametrize(("scale", "values"), [((2, 0.5), (2, 0.5)), ((3, -1), (3, -1)), ((1, 1), (1, 1))])
def test_the_stretch_of_a_scaled_triangle(scale, values):
    uv = V[:, :2] * scale
    assert singular_values(V, F, uv)[0] == pytest.approx(values)


def test_small_words():
    assert sums(np.array([1, 1, 3]), np.array([1.0, 2, 5]), 5).tolist() == [0, 3, 0, 5, 0]
    assert unit(np.array([[3.0, 4], [0, 0]])).tolist() == [[0.6, 0.8], [0, 0]]


def test_area_of_a_ring_tells_which_way_it_runs():
    ring = np.array([[1.0, 1], [5, 1], [5, 4], [3, 2]])
    assert signed_area(ring) == pytest.approx(5.0)
    assert signed_area(ring[::-1]) == pytest.approx(-5.0)
