"""Creases, and normals to shade with."""

import manifold3d
import numpy as np
import pytest

from meshjig.mesh.creases import crease_normals, split_at_creases
from meshjig.mesh.measure import area_vectors, unit
from tests.meshes import sphere


def extruded(ring, height):
    mesh = manifold3d.Manifold.extrude(manifold3d.CrossSection([ring]), height).to_mesh64()
    return np.array(mesh.vert_properties, float)[:, :3], np.array(mesh.tri_verts, np.int64)


def rounded_bar():
    """A bar 40 wide and 20 high, its upper corners rounded in steps of 9 degrees; its sides are slivers."""
    turn = np.linspace(0, np.pi / 2, 11)
    x, y = 5 * np.cos(turn), 5 * np.sin(turn)
    right, left = np.stack([15 + x, 15 + y], 1), np.stack([-15 - x, 15 + y], 1)[::-1]
    return extruded(np.concatenate([[[-20, 0], [20, 0]], right, left]), 60.0)


@pytest.mark.parametrize("teeth", [5, 60])
def test_flat_sides_of_a_star_keep_their_normals_up_to_the_rim(teeth):
    turn = np.arange(2 * teeth) * np.pi / teeth
    radius = np.where(np.arange(2 * teeth) % 2, 14.0, 30.0)
    V, F = extruded(radius[:, None] * np.stack([np.cos(turn), np.sin(turn)], 1), 2.0)
    corner, N = crease_normals(V, F)
    flat = unit(area_vectors(V, F))
    np.testing.assert_allclose(N[corner], np.repeat(flat[:, None], 3, axis=1), atol=1e-9)


def test_a_plane_beside_a_rounded_edge_is_even_and_the_edge_round():
    V, F = rounded_bar()
    corner, N = crease_normals(V, F)
    flat = unit(area_vectors(V, F))
    plane = (np.abs(flat) > 1 - 1e-9).any(axis=1)
    np.testing.assert_allclose(N[corner[plane]], np.repeat(flat[plane][:, None], 3, axis=1), atol=0.01)
    x, y, z = V[F[~plane]].transpose(2, 0, 1)
    truth = unit(np.stack([x - 15 * np.sign(x), y - 15, 0 * z], 2))
    assert (N[corner[~plane]] * truth).sum(axis=2).min() > np.cos(np.radians(6))


def test_a_sphere_is_smooth():
    V, F = sphere(3000)
    corner, N = crease_normals(V, F)
    assert len(N) == len(V)
    assert (N[corner] * unit(V)[F]).sum(axis=2).min() > np.cos(np.radians(2))


def test_vertices_are_doubled_along_creases_only():
    V, F = extruded(np.array([[0.0, 0], [10, 0], [10, 10], [0, 10]]), 10.0)
    G, origin = split_at_creases(V, F)
    assert len(origin) == 24  # three at each of eight corners
    np.testing.assert_array_equal(origin[G], F)


def test_faces_that_meet_three_at_an_edge_are_no_trouble():
    V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]])
    F = np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]])
    corner, N = crease_normals(V, F)
    np.testing.assert_allclose(N[corner[:, 0]], [[0, 0, 1], [0, 0, 1], [0, -1, 0]], atol=1e-12)
