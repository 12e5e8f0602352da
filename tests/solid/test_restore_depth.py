import manifold3d
import numpy as np
import pytest

from meshjig.mesh.mesh import Mesh
from meshjig.solid.offset_sheet import offset_sheet
from meshjig.solid.restore_depth import restore_depth
from meshjig.solid.surface_distance import SurfaceDistance
from tests.meshes import Shape, disc, inside_out, joined, moved, sphere, torus
from tests.solid.test_untangle_sheet import crossings

T = 2.0


def restored(mesh, D, aimed=T):
    mesh = Mesh(*mesh)
    surface = SurfaceDistance(*mesh)
    distance = surface.distance(mesh.V + D)
    D = restore_depth(mesh, D, distance, np.full(len(D), aimed), T, surface)
    return D, distance, surface.distance(mesh.V + D)


def squeezed(mesh, share):
    """Give a good inner sheet, drawn up to a share of its depth within 5 mm of three vertices."""
    D = -T * Mesh(*mesh).vertex_normals
    far = np.linalg.norm(mesh[0][:, None] - mesh[0][[5, 400, 900]], axis=2).min(1)
    D[far < 5.0] *= share
    return D


@pytest.mark.parametrize("mesh", [sphere(6000), torus(6000)], ids=["sphere", "torus"])
@pytest.mark.parametrize("share", [0.02, 0.5])
def test_a_sheet_that_was_drawn_up_is_laid_down_again(mesh, share):
    D, before, after = restored(mesh, squeezed(mesh, share))
    assert before.min() < 0.55 * T
    assert after.min() > 0.9 * T
    assert after.max() < 1.2 * T
    assert crossings(*mesh, D) == 0


def test_only_what_is_near_a_squeezed_place_moves():
    mesh = torus(6000)
    old = squeezed(mesh, 0.1)
    D, before, _ = restored(mesh, old)
    moved = (old != D).any(1)
    middle = mesh[0][before < 0.7 * T]
    assert moved.sum() > 50
    assert np.linalg.norm(mesh[0][moved][:, None] - middle, axis=2).min(1).max() < 4 * T


def test_a_good_sheet_stays_as_it_is_in_every_bit():
    mesh = torus(3000)
    old = squeezed(mesh, 0.75)
    assert (restored(mesh, old)[0] == old).all()


def test_sheets_without_room_stay_where_they_cross_nothing():
    """The sheets of both sides of a wavy plate, which would have to pass through each other."""
    V, F = disc(600, 20.0)
    V = V + np.array([0.0, 0.0, 1.5]) * np.sin(V[:, :1] / 3)
    below = inside_out(moved(Shape(V, F), [0.0, 0.0, -2.4]))
    D = np.repeat([[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]], len(V), 0)
    V, F = joined(Shape(V, F), below)
    assert crossings(V, F, D) == 0
    assert crossings(V, F, restored((V, F), D)[0]) == 0


@pytest.mark.parametrize("name", ["notch", "steps", "ball"])
def test_reentrant_corners_keep_their_depth(name):
    """Corners where coarse sheets fold, and were drawn up to a third of their depth to unfold.

    Faces there are wide: they cut the corner, though their vertices are deep.
    """
    V, F = _arrays(_SHAPES[name], 4.0)
    D, distance, facts = offset_sheet(V, F, T, "miter")
    Q = (V + D)[F]
    inside = np.concatenate([Q.mean(1), (Q + Q[:, [1, 2, 0]]).reshape(-1, 3) / 2])
    assert distance.min() > 0.6 * T
    assert SurfaceDistance(V, F).distance(inside).min() > 0.6 * T
    assert facts.folds.crossings_left == 0
    assert crossings(V, F, D) == 0


def _arrays(solid, length):
    mesh = solid.refine_to_length(length).to_mesh()
    return np.asarray(mesh.vert_properties, np.float64)[:, :3], np.asarray(mesh.tri_verts, np.int64)


def _box(size, at=(0, 0, 0)):
    return manifold3d.Manifold.cube(size, True).translate(at)


_SHAPES = {
    "notch": _box([40, 40, 40]) - _box([20, 20, 20], [20, 20, 20]),
    "steps": _box([40, 40, 10]) + _box([30, 30, 10], [3, 3, 8]) + _box([20, 20, 10], [5, 6, 14]),
    "ball": _box([40, 40, 16]) + manifold3d.Manifold.sphere(14, 48).translate([0, 0, 8]),
}
