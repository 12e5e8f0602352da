"""What was cut twice keeps every promise of what was cut once."""

import numpy as np
import pytest

from meshjig.cut import compose_cuts, overlay
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas, interpolate
from meshjig.mesh.types import Atlas, Mesh
from tests.cut.graphs import assert_sound, atlas, flat_sheet, grid_graph, loops, regular, two_charts, wavy

LINES = np.array([-10.0, 23.0, 47.0, 81.0, 110.0])
DISC = regular(49.3, 52.1, 17.0, 60)  # over a line, a corner and a seam
TURN = np.array([[0.6, 0.8], [-0.8, 0.6]])


def cut_twice(a):
    """Cut along a grid, then the middle of it once more, in a plane that is turned and moved."""
    grid = grid_graph(LINES, LINES)
    first = overlay(a, grid)
    p = first.V[:, :2]
    chosen = np.flatnonzero((np.abs(p[first.F].mean(1) - 50) < 30).all(1))
    F, kept = compact(first.F[chosen])
    uv = p[kept] @ TURN + [300.0, 7.0]
    V = first.V[kept]
    plane = Atlas(Mesh(V, F), uv, F, np.zeros(len(F), np.int64))
    disc = loops(DISC @ TURN + [300.0, 7.0], labels=[1], outside=[0])
    second = overlay(plane, disc)
    return grid, first, second, compose_cuts(a, grid, first, chosen, kept, second)


def sheets():
    p, F = flat_sheet(20)
    yield "one chart", atlas(wavy(p), F, p)
    yield "two charts", two_charts(20, (150.0, 20.0))


@pytest.mark.parametrize("a", [a for _, a in sheets()], ids=[name for name, _ in sheets()])
def test_a_mesh_cut_twice_is_sound_and_has_both_cuts(a):
    grid, first, second, further = cut_twice(a)
    cut, outlines = further.cut, further.outlines
    assert_sound(a, cut)
    np.testing.assert_array_equal(cut.V[: len(first.V)], first.V)

    # nothing of the first cut is lost: its segments are as long as they were
    def covered(c):
        return np.bincount(c.cut_segment, np.diff(c.cut_param, axis=1)[:, 0], len(outlines.segments))

    n = len(grid.segments)
    np.testing.assert_allclose(covered(cut)[:n], covered(first)[:n], atol=1e-9)
    np.testing.assert_allclose(covered(cut)[n:], 1.0)
    assert len(cut.cuts) > len(first.cuts) + len(second.cuts)  # where they cross, cuts were divided

    # every end of a cut lies where the outlines say, in the chart that it was cut in
    S = outlines.segments[cut.cut_segment]
    for k in (0, 1):
        t = cut.cut_param[:, [k]]
        drawn = outlines.points[S[:, 0]] * (1 - t) + outlines.points[S[:, 1]] * t
        right = drawn[:, 0] > 125
        drawn = drawn - right[:, None] * [150.0, 20.0]
        np.testing.assert_allclose(cut.V[cut.cuts[:, k], :2], drawn, atol=1e-3)


def test_points_and_areas_of_the_second_outlines_are_found_again():
    p, F = flat_sheet(20)
    a = atlas(np.column_stack([p, np.zeros(len(p))]), F, p)
    *_, further = cut_twice(a)
    cut = further.cut
    assert (further.point >= 0).all()
    at = cut.point_vertex[further.point]
    np.testing.assert_allclose(cut.V[at, :2], DISC, atol=1e-3)
    np.testing.assert_allclose(further.outlines.points[further.point], DISC, atol=1e-3)
    inside = cut.label == cut.label.max()
    x, y = DISC.T
    area = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    assert face_areas(cut.V, cut.F)[inside].sum() == pytest.approx(area, rel=1e-5)
    assert (np.diff(further.part_of) >= 0).all()
    middle = interpolate(a.uv, a.F_uv, cut.vertex_face, cut.vertex_bary)[cut.F[inside]].mean(1)
    assert np.linalg.norm(middle - [49.3, 52.1], axis=1).max() < 17.0
    left = further.outlines.left[cut.cut_segment[-1]], further.outlines.right[cut.cut_segment[-1]]
    assert set(left) == {cut.label.max(), cut.label.max() - 1}
