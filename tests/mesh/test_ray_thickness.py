"""Thickness by rays: of a plate, of a ball, and at an edge, which has no far side."""

import numpy as np
import trimesh

from meshjig.mesh.mesh import Mesh
from meshjig.mesh.ray_thickness import ray_thickness


def mesh(solid: trimesh.Trimesh) -> Mesh:
    return Mesh(np.asarray(solid.vertices, float), np.asarray(solid.faces, np.int64))


def test_a_plate_is_as_thick_as_it_is() -> None:
    plate = mesh(trimesh.creation.box((40, 30, 3)).subdivide().subdivide())
    found = ray_thickness(plate)
    N = plate.area_vectors / np.linalg.norm(plate.area_vectors, axis=1)[:, None]
    flat = np.abs(N[:, 2]) > 0.5
    assert np.allclose(found.depth[flat], 3, atol=1e-3)
    assert np.allclose(found.across[flat], N[flat], atol=1e-6)
    assert np.allclose(N[found.far[flat]], -N[flat])
    assert (found.depth[~flat] >= 30 - 1e-3).all()


def test_what_is_thicker_than_asked_counts_as_infinite() -> None:
    ball = mesh(trimesh.creation.icosphere(3, 10.0))
    found = ray_thickness(ball, 15.0)
    assert np.isinf(found.depth).all()
    assert (found.far == -1).all()
    assert not found.across.any()
    assert (ray_thickness(ball).depth < 20.01).all()


def test_the_flanks_of_an_edge_are_not_two_sides() -> None:
    box = mesh(trimesh.creation.box((10, 10, 50)).subdivide().subdivide().subdivide())
    assert np.isinf(ray_thickness(box, 9.0).depth).all()
    assert ray_thickness(box).depth.min() > 9.99
