"""Which sides of thin parts give pieces, and which are left out."""

import numpy as np
import trimesh

from meshjig.mesh.mesh import Mesh
from meshjig.mesh.ray_thickness import ray_thickness
from meshjig.thin import through_parts, ways_through
from meshjig.thin.sides import choose_sides
from meshjig.thin.thin_faces import thin_faces
from tests.thin import shapes


def test_a_ball_has_nothing_thin() -> None:
    ball = trimesh.creation.icosphere(3, 10.0)
    mesh = Mesh(np.asarray(ball.vertices, float), np.asarray(ball.faces, np.int64))
    assert through_parts(mesh, 6.0, 2.6) is None


def test_one_side_of_a_plate_is_left_out() -> None:
    surface, parts = through_parts(Mesh(*shapes.plate()), 6.0, 2.6)
    N = surface.area_vectors / (2 * surface.areas[:, None])
    up = (np.abs(surface.V[surface.F].mean(axis=1)) < [36, 26, 9]).all(axis=1)
    assert not (parts.owns & parts.far).any()
    assert np.ptp(np.sign(N[up & parts.owns, 2])) == 0
    assert np.ptp(np.sign(N[up & parts.far, 2])) == 0
    assert (parts.owns | parts.far)[up].all()
    assert np.allclose(np.abs(parts.direction[up, 2]), 1, atol=0.05)


def test_the_way_through_a_plate_is_as_long_as_it_is_thick() -> None:
    surface, parts = through_parts(Mesh(*shapes.plate()), 6.0, 2.6)
    ways = ways_through(surface, parts.direction, parts.owns, parts.far, 6.0)
    inner = (np.abs(surface.V) < [36, 26, 9]).all(axis=1)
    found = (ways.length > 0) & inner
    assert found.sum() > 500
    assert np.abs(ways.length[found] - 3.0).max() < 0.3
    assert (ways.free[found] > 1e6).all()


def test_both_sides_of_a_rod_are_told_apart_all_along_it() -> None:
    mesh = Mesh(*shapes.thin_torus())
    rays = ray_thickness(mesh, 6.0)
    thin = thin_faces(mesh, rays, 6.0, 2.6)
    assert thin.all()
    sides = choose_sides(mesh, thin, rays, 12.0)
    share = mesh.areas[sides.owns].sum() / mesh.areas.sum()
    assert 0.25 < share < 0.6
    centre = mesh.V[mesh.F].mean(axis=1)
    around = np.arctan2(centre[:, 1], centre[:, 0])
    for sector in np.linspace(-np.pi, np.pi, 9)[:-1]:
        here = (around >= sector) & (around < sector + np.pi / 4)
        assert 0.2 < mesh.areas[here & sides.owns].sum() / mesh.areas[here].sum() < 0.65


def test_what_is_too_small_is_no_part_unless_it_is_thinner_than_two_walls() -> None:
    """A block with a fin of 2 x 2 mm: 8 mm2 on both sides."""
    block = trimesh.creation.box((20, 20, 20)).union(
        trimesh.creation.box((0.8, 2, 4), trimesh.transformations.translation_matrix((0, 0, 10)))
    )
    made = block.subdivide_to_size(0.7)
    mesh = Mesh(np.asarray(made.vertices, float), np.asarray(made.faces, np.int64))
    rays = ray_thickness(mesh, 6.0)
    assert (rays.depth < 1.0).any()
    assert not thin_faces(mesh, rays, 6.0, 0.0).any()
    assert thin_faces(mesh, rays, 6.0, 2.6).any()
