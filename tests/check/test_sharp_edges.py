"""Sharp edges are told from skins."""

import manifold3d
import numpy as np
import pytest

from meshjig.check import judge

LEAST = 1.2


def prism(outline, length=20.0):
    """Make a solid of a cross-section, (V, F)."""
    solid = manifold3d.CrossSection([outline]).extrude(length)
    mesh = solid.to_mesh()
    return np.asarray(mesh.vert_properties, np.float64)[:, :3], np.asarray(mesh.tri_verts, np.int64)


def wedge(degrees):
    """Make a slice of a pie of 12 mm."""
    half = np.radians(degrees) / 2
    return prism(
        [(0.0, 0.0), (12 * np.cos(half), -12 * np.sin(half)), (12 * np.cos(half), 12 * np.sin(half))]
    )


def thin(mesh):
    tilt = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    tilt *= np.sign(np.linalg.det(tilt))
    return judge([(mesh[0] @ tilt, mesh[1])], min_wall=LEAST).checks["thin_walls"]


@pytest.mark.parametrize(("degrees", "found"), [(20, 1), (28, 1), (32, 0), (45, 0), (58, 0)])
def test_a_sharp_edge_is_no_skin_from_30_degrees_on(degrees, found):
    assert thin(wedge(degrees)) == found


@pytest.mark.parametrize("degrees", [0, 20, 32, 45])
def test_a_skin_between_sides_that_lean_is_found(degrees):
    """A bar with a fin on it, 3 mm long, whose sides are parallel or would meet beyond its blunt end."""
    lean = 3 * np.tan(np.radians(degrees) / 2)
    outline = [(0, 0), (10, 0), (10, 4), (5.4 + lean, 4), (5.4, 7), (4.6, 7), (4.6 - lean, 4), (0, 4)]
    assert thin(prism([(float(x), float(y)) for x, y in outline])) == 1


def test_a_skin_with_teeth_is_found():
    """A plate 0.8 mm thick with ridges of 100 degrees, whose flanks' planes meet the back at 40 degrees."""
    x = np.arange(0.0, 20.5, 0.5)
    teeth = np.column_stack([x, 0.8 + 0.42 * (np.arange(len(x)) % 2)])
    assert thin(prism([(0.0, 0.0), (20.0, 0.0), *map(tuple, teeth[::-1])])) == 1
