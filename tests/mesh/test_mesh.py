"""A mesh unpacks, and keeps what follows from its faces."""

import pickle

import numpy as np

from meshjig.mesh.mesh import Mesh, concatenate
from tests.meshes import disc, half_sphere, joined, moved, sphere


def test_a_mesh_unpacks_as_its_arrays():
    V, F = sphere(200)
    mesh = Mesh(V, F)
    W, G = mesh
    assert W is V
    assert G is F


def test_what_follows_is_worked_out_once_and_stays_behind_when_sent():
    mesh = Mesh(*sphere(200))
    assert mesh.edges is mesh.edges
    sent = pickle.loads(pickle.dumps(mesh))
    assert set(vars(sent)) == {"V", "F"}
    np.testing.assert_array_equal(sent.F, mesh.F)


def test_counts_and_measures():
    two = Mesh(*joined(half_sphere(500), moved(sphere(500), [200, 0, 0])))
    assert two.n_components == 2
    rim = two.F.ravel()[two.borders]
    assert len(rim) == two.is_border_vertex.sum() > 10
    assert set(two.component_of_face[two.borders // 3].tolist()) == {int(two.component_of_face[0])}
    np.testing.assert_allclose(np.linalg.norm(two.area_vectors, axis=1) / 2, two.areas)
    middle = two.V[~two.is_border_vertex][:50]
    outward = middle / np.linalg.norm(middle, axis=1, keepdims=True)
    assert (np.einsum("ij,ij->i", outward, two.vertex_normals[~two.is_border_vertex][:50]) > 0.9).all()


def test_a_moved_mesh_keeps_its_edges_and_measures_again():
    mesh = Mesh(*sphere(500))
    e, area = mesh.edges, mesh.areas
    other = mesh.moved(2 * mesh.V)
    assert other.edges is e
    np.testing.assert_allclose(other.areas, 4 * area)
    assert mesh.moved(mesh.V) is mesh


def test_meshes_are_put_one_after_the_other_and_stay_apart():
    parts = [sphere(100), disc(200), sphere(300)]
    V, F, part_of_vertex, part_of_face = concatenate(parts)
    for k, part in enumerate(parts):
        np.testing.assert_array_equal(V[part_of_vertex == k], part.V)
        np.testing.assert_array_equal(V[F[part_of_face == k]], part.V[part.F])
