"""Cut curves follow the outlines, in the plane and in space."""

import numpy as np
import shapely

from meshjig.cut.cut_curves import cut_curves
from meshjig.cut.overlay import overlay
from meshjig.mesh.types import Outlines
from tests.cut.graphs import grid_graph, loops, regular, sheet_atlas, square, tube_atlas, wavy

LINES = np.arange(5.0, 100, 10)


def assert_paired(a, plane, space):
    assert len(plane) == len(space)
    for uv, x in zip(plane, space, strict=True):
        assert len(uv) == len(x) >= 2
        np.testing.assert_allclose(np.column_stack([uv, x[:, 2]]), x, atol=0.5)
        assert np.linalg.norm(np.diff(uv, axis=0), axis=1).max() < 10


def test_a_grid_falls_into_the_lines_between_its_junctions():
    a, g = sheet_atlas(13), grid_graph(LINES, LINES, 4)
    plane, space = cut_curves(overlay(a, g), g)
    assert_paired(a, plane, space)
    # 2 x 10 lines of 9 sides; the 4 corners of the grid join two sides each
    assert len(plane) == 180 - 4
    lines = shapely.MultiLineString(plane)
    assert abs(lines.length - 2 * 10 * 90) < 1e-2


def test_closed_curves_come_back_to_their_start():
    a, rings = sheet_atlas(13), [regular(30, 30, 20, 50), square(70, 70, 15)]
    g = loops(*rings, labels=[1, 2])
    plane, space = cut_curves(overlay(a, g), g)
    assert_paired(a, plane, space)
    assert len(plane) == 2
    for uv, x in zip(plane, space, strict=True):
        np.testing.assert_array_equal(x[0], x[-1])
        np.testing.assert_allclose(uv[0], uv[-1], atol=1e-6)
    area = sorted(shapely.Polygon(uv).area for uv in plane)
    np.testing.assert_allclose(area, sorted(shapely.Polygon(r).area for r in rings), rtol=1e-5)


def test_points_in_space_lie_on_the_surface_above_the_plane():
    a, g = sheet_atlas(60), loops(regular(50, 50, 30, 200), labels=[1])
    plane, space = cut_curves(overlay(a, g), g)
    np.testing.assert_allclose(space[0], wavy(plane[0]), atol=0.03)


def test_curves_end_at_a_seam():
    a = tube_atlas()
    g = grid_graph(np.array([-6.0, 126.0]), np.array([22.0, 58.0]))
    plane, space = cut_curves(overlay(a, g), g)
    assert len(plane) == 2
    for uv, x in zip(plane, space, strict=True):
        np.testing.assert_allclose(np.sort(uv[[0, -1], 0]), [0, 120], atol=1e-3)
        np.testing.assert_allclose(x[0], x[-1], atol=1e-3)


def test_without_cuts_there_are_no_curves():
    nothing = np.zeros((0, 2))
    g = Outlines(nothing, nothing.astype(np.int64), np.zeros(0, np.int64), np.zeros(0, np.int64))
    assert cut_curves(overlay(sheet_atlas(2), g), g) == ([], [])
