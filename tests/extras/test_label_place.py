"""Places lie on the sheet, clear of its border, flat enough, the right way round."""

import numpy as np
import pytest

from meshjig.extras.label_place import label_places
from meshjig.mesh.measure import unit
from tests.extras.sheets import plate
from tests.meshes import Shape, cylinder, half_sphere, inside_out

SIZE = np.array([9.0, 5.0])


def l_shape(n=40):
    """Two arms, 9 mm wide and 30 mm long, in the plane."""
    V, F = (x for x in plate(30, 30, 1.0, n)[1].__dict__.values())
    middle = V[F].mean(1)
    return Shape(V, F[(middle[:, 0] < -6) | (middle[:, 1] < -6)])


@pytest.mark.parametrize("turn", np.linspace(0, np.pi, 7))
def test_rectangle_lies_within_the_sheet_with_its_margin(turn):
    import shapely

    V, F = l_shape()
    cos, sin = np.cos(turn), np.sin(turn)
    V = V @ np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]])
    sheet = shapely.union_all([shapely.Polygon(t) for t in V[F][:, :, :2]])
    i, place = next(label_places(V, F, [SIZE], 1.0))
    assert i == 0
    half = (SIZE / 2 + 0.95) * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    corners = place.origin[:2] + half @ place.axes[:2, :2]
    assert sheet.buffer(1e-6).contains(shapely.Polygon(corners))


def test_the_largest_size_that_fits_is_taken():
    V, F = l_shape()
    sizes = [np.array([28.0, 12.0]), np.array([20.0, 6.0]), SIZE]
    assert next(label_places(V, F, sizes, 1.0))[0] == 1


def test_nothing_fits_where_there_is_no_room():
    V, F = l_shape()
    assert not list(label_places(V, F, [np.array([9.0, 9.0])], 1.0))
    assert not list(label_places(V, F[:0], [SIZE], 1.0))


@pytest.mark.parametrize("shape", [half_sphere(3000), inside_out(half_sphere(3000)), cylinder(3000)])
def test_axes_are_right_handed_and_look_along_the_sheets_normal(shape):
    found = list(label_places(*shape, [SIZE], 1.0))
    assert found
    for _, place in found:
        assert np.linalg.det(place.axes) == pytest.approx(1.0)
        corners = shape.V[shape.F[place.ground]]
        normal = unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        assert (normal @ place.axes[2]).min() > 0.7
        assert place.axes[1] @ [0, 1, 1] > -1e-9
        nearest = np.linalg.norm(corners.mean(axis=1) - place.origin, axis=1).min()
        assert nearest < 3.0


def test_text_runs_along_a_trough():
    V, F = inside_out(cylinder(4000))
    V = V * [0.16, 0.16, 1.0]  # radius 4 mm
    _, place = next(label_places(V, F, [np.array([12.0, 3.0])], 0.5))
    assert abs(place.axes[0, 2]) > 0.9
