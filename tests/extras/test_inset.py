"""The surface at a depth is closed, lies at that depth, and leaves thin parts out."""

import numpy as np
import pytest

from meshjig.check.closed import is_closed
from meshjig.extras.carve_clearance import carve_clearance
from meshjig.extras.depth import Depth
from meshjig.extras.inset import inset_surface
from meshjig.mesh.booleans import arrays, body, sound
from meshjig.mesh.components import components
from meshjig.mesh.measure import mesh_volume
from tests.check.pieces import box
from tests.meshes import Shape, creased_box, genus2, joined, noisy, sphere, torus


@pytest.mark.parametrize(
    "shape", [sphere(2000), torus(2000), genus2(800), creased_box(600), noisy(torus(2000), 0.2)]
)
@pytest.mark.parametrize("depth", [0.5, 3.0])
def test_surface_is_closed_and_lies_at_its_depth(shape, depth):
    surface = Depth(*shape)
    V, F = inset_surface(surface, depth, 2.0)
    assert is_closed(F)
    assert sound(body(V, F))
    assert mesh_volume(V, F) > 0
    found = surface.at(V)[0]
    assert np.median(found) == pytest.approx(depth, abs=0.1)
    assert np.abs(found - depth).max() < 1.5


def test_volume_is_that_of_the_smaller_ball():
    V, F = inset_surface(Depth(*sphere(20_000)), 4.0, 1.5)
    assert mesh_volume(V, F) == pytest.approx(4 / 3 * np.pi * 46**3, rel=0.01)


def test_where_nothing_lies_so_deep_there_is_no_surface():
    V, F = inset_surface(Depth(*creased_box(600)), 51.0, 2.0)
    assert len(V) == len(F) == 0


@pytest.mark.parametrize(("width", "kept"), [(1.0, False), (6.0, True)])
@pytest.mark.parametrize("cell", [0.7, 1.5])
def test_thin_fins_are_left_out(width, kept, cell):
    import manifold3d

    block, fin = body(*box([0, 0, 0], [20, 20, 20])), body(*box([19, 3, 10], [40, 17, 10 + width]))
    mesh = manifold3d.Manifold.to_mesh64(block + fin)
    V = np.array(mesh.vert_properties)[:, :3]
    made, _ = inset_surface(Depth(V, np.array(mesh.tri_verts, np.int64)), 0.2, cell, 3.0)
    assert (made[:, 0].max() > 35) == kept
    assert made[:, 0].max() > 19


def test_bodies_that_touch_by_a_corner_only_come_apart():
    a, b = creased_box(48), creased_box(48)
    both = joined(a, Shape(b.V + np.array([100.6, 100.6, 0.3]), b.F))
    _, F = inset_surface(Depth(*both), -0.5, 4.0)
    assert is_closed(F)
    _, F = inset_surface(Depth(*both), 0.5, 4.0)
    assert is_closed(F)
    assert components(F)[0] == 2


@pytest.mark.parametrize("distance", [0.3, 2.0])
def test_carving_leaves_the_distance_and_little_more(distance):
    import igl

    block = body(*box([0, 0, 0], [20, 20, 20]))
    V, F = np.array([[5.0, 5, 20], [15, 5, 20], [10, 15, 20]]), np.array([[0, 1, 2]])
    W, G = arrays(carve_clearance(block, V, F, distance))
    points = np.concatenate([W, W[G].mean(axis=1)])
    away = np.sqrt(igl.point_mesh_squared_distance(points, V, F)[0])
    assert away.min() >= distance * (1 - 1e-9)
    below = points[(np.abs(points[:, 0] - 10) < 2) & (np.abs(points[:, 1] - 8) < 2)]
    assert 20 - below[below[:, 2] > 15][:, 2].max() == pytest.approx(distance, rel=0.2)


def test_surface_that_crosses_itself_has_a_closed_inset_all_the_same():
    V, F = inset_surface(Depth(*noisy(torus(2000), 0.5), crossed=True), 0.5, 2.0)
    assert is_closed(F)
    assert sound(body(V, F))
