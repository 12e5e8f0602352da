"""Depth is the distance, with the winding number's sign."""

import numpy as np
import pytest

from meshjig.extras.cap_openings import cap_openings
from meshjig.extras.depth import Depth
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import face_areas, mesh_volume
from meshjig.mesh.types import Mesh
from tests.meshes import (
    Shape,
    cavity_shell,
    creased_box,
    cylinder,
    disc,
    genus2,
    half_sphere,
    noisy,
    open_cup,
    sphere,
    torus,
)

CLOSED = [sphere(500), torus(600), genus2(400), creased_box(300), cavity_shell(600), noisy(torus(800), 0.15)]


@pytest.mark.parametrize("shape", CLOSED)
@pytest.mark.parametrize("crossed", [False, True])
def test_depth_is_positive_where_the_surface_winds_around(shape, crossed):
    import igl

    rng = np.random.default_rng(0)
    points = rng.uniform(-60, 60, (3000, 3))
    points[:1000] = shape.V[rng.integers(len(shape.V), size=1000)] + rng.normal(size=(1000, 3)) * 0.1
    depth, foot = Depth(*shape, crossed=crossed).at(points)
    inside = igl.winding_number(shape.V, shape.F, points) > 0.5
    assert ((depth > 0) == inside).all()
    assert np.allclose(np.abs(depth), np.linalg.norm(points - foot, axis=1))
    assert np.allclose(depth**2, igl.point_mesh_squared_distance(points, shape.V, shape.F)[0])


def test_crossed_surfaces_are_inside_wherever_one_of_them_is():
    V, F = sphere(500)
    shifted = V + np.array([40.0, 0, 0])
    both = Shape(np.concatenate([V, shifted]), np.concatenate([F, F + len(V)]))
    points = np.random.default_rng(0).uniform(-60, 60, (2000, 3))
    depth, _ = Depth(*both, crossed=True).at(points)
    near = [np.abs(np.linalg.norm(points - c, axis=1) - 50) < 2 for c in ([0, 0, 0], [40, 0, 0])]
    inside = [np.linalg.norm(points - c, axis=1) < 50 for c in ([0, 0, 0], [40, 0, 0])]
    clear = ~(near[0] | near[1])
    assert ((depth > 0) == (inside[0] | inside[1]))[clear].all()


@pytest.mark.parametrize(
    "shape", [half_sphere(1000), cylinder(800), open_cup(800), noisy(half_sphere(1000), 0.2)]
)
def test_openings_are_closed_by_flat_lids(shape):
    V, F, area = cap_openings(*shape)
    assert not len(border_halfedges(F))
    assert mesh_volume(V, F) > 0
    assert np.array_equal(F[: len(shape.F)] < len(V), np.ones((len(shape.F), 3), bool))
    lid = F[len(shape.F) :]
    assert face_areas(V, lid).sum() == pytest.approx(area)
    loops = {1: np.pi * 50**2, 2: 2 * np.pi * 25**2}
    assert min(abs(area / x - 1) for x in (*loops.values(), np.pi * 25**2)) < 0.06


def test_closed_surfaces_stay_as_they_are():
    V, F, area = cap_openings(*sphere(300))
    assert area == 0
    assert np.array_equal(F, sphere(300).F)
    assert len(V) == len(sphere(300).V)


def test_flat_sheets_close_to_nothing():
    V, F, _ = cap_openings(*disc(300))
    assert mesh_volume(V, F) == pytest.approx(0, abs=1e-6)


def test_another_surface_beside_is_kept_away_from_and_has_no_inside():
    ball, plate = sphere(2000), disc(400)  # the plate goes through the middle of the ball
    points = np.array([[0.0, 0.0, 3.0], [0.0, 0.0, -3.0], [0.0, 0.0, 48.0], [0.0, 0.0, 60.0]])
    alone = Depth(*ball).at(points)[0]
    both = Depth(*ball, beside=Mesh(*plate)).at(points)[0]
    assert alone[:2] == pytest.approx([47.0, 47.0], abs=0.5)
    assert both[:2] == pytest.approx([3.0, 3.0], abs=1e-6)
    assert both[2:] == pytest.approx(alone[2:])
