"""The ground under a place of the plane, and distances lifted from there, are those of the surface."""

import numpy as np
import pytest

from meshjig.cells.knobs.surface_grid import Lift, surface_grid
from meshjig.mesh.types import Atlas
from tests.cells.knobs.knob_sheets import EDGE, rolled, square_cells


def test_normals_and_scale_are_those_of_a_cylinder():
    atlas = square_cells(3, shape=rolled)
    half = Atlas(atlas.mesh, atlas.uv / 2, atlas.F_uv, atlas.chart_of_face)
    place = half.uv[half.F_uv].mean(1)
    grid = surface_grid(half, 0.4)
    at = atlas.mesh.V[atlas.mesh.F].mean(1)
    outward = at * [1, 0, 1] / np.linalg.norm(at * [1, 0, 1], axis=1, keepdims=True)
    assert ((grid.normals(place) * outward).sum(1) > np.cos(np.radians(3))).all()
    np.testing.assert_allclose(grid.scale(place), 2, rtol=1e-2)


def test_places_without_a_face_take_the_nearest():
    grid = surface_grid(square_cells(1, fine=2), 0.2)
    np.testing.assert_allclose(grid.normals(np.full((3, 2), EDGE / 2)), [[0, 0, 1]] * 3)
    np.testing.assert_allclose(grid.scale(np.array([[-50.0, 90.0], [1.0, 1.0]])), 1)


@pytest.mark.parametrize("fine", [3, 12])
def test_widths_are_chords_of_a_cylinder(fine):
    atlas = square_cells(1, fine=fine, shape=rolled)
    a, b = np.random.default_rng(0).uniform(0, EDGE, (2, 50, 2))
    chord = np.linalg.norm(rolled(a) - rolled(b), axis=1)
    np.testing.assert_allclose(Lift(atlas).widths(np.stack([a, b], 1)), chord, atol=4.0 / fine**2)
