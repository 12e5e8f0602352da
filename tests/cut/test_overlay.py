"""The overlay keeps its promises on clean and on hostile input."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.cut.overlay import overlay
from meshjig.errors import CutError
from meshjig.mesh.measure import interpolate
from meshjig.mesh.types import Outlines
from tests.cut.graphs import (
    SIDE,
    assert_sound,
    atlas,
    clear_of,
    delaunay,
    flat_sheet,
    grid_graph,
    loops,
    midpoints_uv,
    patches,
    regular,
    sheet_atlas,
    shortest_edge,
    slit_sheet,
    square,
    tube_atlas,
    two_charts,
    wavy,
)

TENS = np.arange(0, 101, 10.0)
WIDE = np.arange(-50, 151, 7.0)


def grid_label(q, lines, turn=0.0):
    """Number the cells of a grid graph by arithmetic."""
    back = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    q = (q - SIDE / 2) @ back + SIDE / 2
    i = np.searchsorted(lines, q[:, 0]) - 1
    j = np.searchsorted(lines, q[:, 1]) - 1
    n = len(lines) - 1
    return np.where((i >= 0) & (i < n) & (j >= 0) & (j < n), i + j * n, -1)


def assert_labels(a, cut, outlines, expected):
    q = midpoints_uv(a, cut)
    clear = clear_of(outlines, q, 2e-3)
    assert clear.sum() > 100
    np.testing.assert_array_equal(cut.label[clear], expected(q[clear]))


@pytest.mark.parametrize("turn", [0.0, np.pi / 4, 0.3])
@pytest.mark.parametrize(
    "lines", [TENS, TENS[1:-1], TENS[:-1] + 5, WIDE], ids=["border", "vertices", "between", "beyond"]
)
@pytest.mark.parametrize("parts", [1, 3, 10])
def test_grid_graphs_with_junctions_on_mesh_vertices_and_lines_along_edges(turn, lines, parts):
    a, g = sheet_atlas(20), grid_graph(lines, lines, parts, turn)
    cut = overlay(a, g)
    assert_sound(a, cut)
    assert shortest_edge(cut) > 5e-5
    assert_labels(a, cut, g, lambda q: grid_label(q, lines, turn))


@pytest.mark.parametrize("n", [1, 2, 3])
def test_a_hundred_tiles_in_a_few_faces(n):
    lines = np.linspace(3, 97, 11)
    a, g = sheet_atlas(n), grid_graph(lines, lines, 3)
    cut = overlay(a, g)
    assert_sound(a, cut)
    assert_labels(a, cut, g, lambda q: grid_label(q, lines))
    assert len(np.unique(cut.label)) == 101


@pytest.mark.parametrize("n", [1, 2, 3])
def test_a_hundred_loose_loops_in_a_few_faces(n):
    centres = [(x, y) for x in np.arange(5, 100, 10.0) for y in np.arange(5, 100, 10.0)]
    g = loops(*[regular(x, y, 4, 12) for x, y in centres], labels=list(range(100)))
    a = sheet_atlas(n)
    cut = overlay(a, g)
    assert_sound(a, cut)
    q = midpoints_uv(a, cut)
    inside, polygon = shapely.STRtree(shapely.polygons([regular(x, y, 4, 12) for x, y in centres])).query(
        shapely.points(q), predicate="within"
    )
    expected = np.full(len(q), -1)
    expected[inside] = polygon
    clear = clear_of(g, q, 2e-3)
    np.testing.assert_array_equal(cut.label[clear], expected[clear])


def test_loops_within_loops_in_one_face():
    rings = [square(70, 30, 20), square(70, 30, 10), square(70, 30, 5), regular(55, 30, 1.5, 7)]
    g = loops(*rings, labels=[1, 2, 3, 4], outside=[0, 1, 2, 1])
    a = sheet_atlas(1)
    cut = overlay(a, g)
    assert_sound(a, cut)
    area = np.bincount(cut.label, shapely.area(shapely.polygons(_uv_triangles(a, cut))), 5)
    areas = [shapely.Polygon(r).area for r in rings]
    expected = [1e4 - areas[0], areas[0] - areas[1] - areas[3], areas[1] - areas[2], areas[2], areas[3]]
    np.testing.assert_allclose(area, expected, rtol=1e-4)


def _uv_triangles(a, cut):
    """Give the plane corners of sub-faces of a sheet whose space is over its plane."""
    return interpolate(a.uv, a.F_uv, cut.vertex_face, cut.vertex_bary)[cut.F]


def test_squares_that_touch_at_a_corner_inside_one_face():
    points = np.array([[60, 10], [70, 10], [70, 20], [60, 20], [80, 20], [80, 30], [70, 30]], float)
    ends = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [2, 4], [4, 5], [5, 6], [6, 2]])
    g = Outlines(points, ends, np.repeat([1, 2], 4), np.full(8, -1))
    for n in (1, 3, 10):
        a = sheet_atlas(n)
        cut = overlay(a, g)
        assert_sound(a, cut)
        area = np.bincount(cut.label + 1, shapely.area(shapely.polygons(_uv_triangles(a, cut))))
        np.testing.assert_allclose(area, [1e4 - 200, 0, 100, 100], atol=2e-2)
        assert cut.region.max() == 2


@pytest.mark.parametrize("shift", [(30.0, 0.0), (30.0, 3.7), (30.0, -11.3)])
def test_cuts_meet_a_seam_between_charts_at_equal_and_at_different_places(shift):
    a, g = two_charts(20, shift), grid_graph(WIDE, WIDE, 2, 0.3)
    cut = overlay(a, g)
    assert_sound(a, cut)
    assert shortest_edge(cut) > 5e-5
    assert_labels(a, cut, g, lambda q: grid_label(q, WIDE, 0.3))


def test_cuts_that_meet_over_a_seam_share_their_vertex():
    lines = np.arange(-6, 127, 12.0)
    g = grid_graph(lines, np.arange(4, 80, 8.0))
    a = tube_atlas()
    cut = overlay(a, g)
    assert_sound(a, cut)
    assert cut.facts.seam_merged == 10
    on_seam = np.flatnonzero(np.abs(np.arctan2(cut.V[:, 1], cut.V[:, 0])) < 1e-9)
    assert len(on_seam) == 17 + 10


def test_what_has_no_label_stays_apart_over_a_seam():
    away = loops(square(-50, -50, 1), labels=[1], outside=[-1])
    cut = overlay(two_charts(4, (30, 0)), away)
    assert (cut.label == -1).all()
    assert cut.region.max() == 1


def test_regions_of_one_label_that_do_not_meet_stay_apart():
    parts = [square(20, 20, 5), square(80, 20, 5), square(50, 70, 9)]
    cut = overlay(slit_sheet(20), loops(*parts, labels=[3, 3, 3], outside=[0, 0, 0]))
    assert len(np.unique(cut.region[cut.label == 3])) == 3
    across = overlay(slit_sheet(20), loops(square(50, 20, 9), labels=[3], outside=[0]))
    assert len(np.unique(across.region[across.label == 3])) == 1


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_a_chart_with_a_slit(turn):
    a, g = slit_sheet(20), grid_graph(WIDE, WIDE, 2, turn)
    cut = overlay(a, g)
    assert_sound(a, cut)
    whole = overlay(sheet_atlas(20), g)
    assert_labels(a, cut, g, lambda q: grid_label(q, WIDE, turn))
    assert cut.facts.seam_merged > 0
    assert len(cut.V) == len(whole.V)


@pytest.mark.parametrize("noise", [0.2, 1.0, 5.0])
def test_pull_back_through_noisy_and_folded_charts(noise):
    p, F = flat_sheet(25)
    uv = p + noise * 4 * np.random.default_rng(0).uniform(-1, 1, p.shape)
    a, g = atlas(wavy(p), F, uv), grid_graph(WIDE, WIDE, 3, 0.3)
    cut = overlay(a, g)
    assert_sound(a, cut)
    assert_labels(a, cut, g, lambda q: grid_label(q, WIDE, 0.3))


@pytest.mark.parametrize(
    "squash", [np.diag([1, 0]), np.zeros((2, 2)), np.diag([-1, 1])], ids=["line", "point", "mirror"]
)
def test_charts_without_area_or_face_down(squash):
    p, F = flat_sheet(20)
    a, g = atlas(wavy(p), F, p @ squash + 3.0), grid_graph(WIDE, WIDE, 3, 0.3)
    cut = overlay(a, g)
    assert_sound(a, cut)
    assert_labels(a, cut, g, lambda q: grid_label(q, WIDE, 0.3))


@pytest.mark.parametrize("lines", [TENS[1:-1], np.arange(0, 101, 3.0)])
def test_charts_rounded_until_many_faces_have_no_area(lines):
    p, F = flat_sheet(50)
    a, g = atlas(wavy(p), F, np.round(p / 3) * 3), grid_graph(lines, lines)
    cut = overlay(a, g)
    assert_sound(a, cut)
    assert shortest_edge(cut) > 5e-5
    assert_labels(a, cut, g, lambda q: grid_label(q, lines))


def test_without_outlines_nothing_is_cut():
    a = two_charts(4, (30, 0))
    nothing = np.zeros((0, 2))
    cut = overlay(
        a, Outlines(nothing, nothing.astype(np.int64), np.zeros(0, np.int64), np.zeros(0, np.int64))
    )
    np.testing.assert_array_equal(cut.F, a.mesh.F)
    assert (cut.label == 0).all()
    assert cut.region.max() == 0  # one label on both sides of the seam is one region
    assert_sound(a, cut)


def test_charts_that_no_outline_touches_are_labelled_by_where_they_lie():
    a = two_charts(4, (200, 0))
    g = loops(square(60, 50, 70), square(300, 50, 45), square(450, 50, 5), labels=[5, 6, 7])
    assert set(overlay(a, g).label) == {5, 6, -1}
    far = loops(square(60, 50, 500), square(60, 50, 400), labels=[5, 6], outside=[-1, 5])
    assert set(overlay(a, far).label) == {6}
    beside = loops(square(-500, 50, 5), labels=[5], outside=[3])
    assert set(overlay(a, beside).label) == {3}


def test_vertices_lie_where_the_outlines_points_lie():
    a, g = sheet_atlas(13), grid_graph(TENS + 2, TENS + 2, 3, 0.3)
    cut = overlay(a, g)
    there = np.flatnonzero(cut.point_vertex >= 0)
    inside = ((g.points > 0) & (g.points < SIDE)).all(axis=1)
    np.testing.assert_array_equal(there, np.flatnonzero(inside))
    v = cut.point_vertex[there]
    uv = interpolate(a.uv, a.F_uv, cut.vertex_face[v], cut.vertex_bary[v])
    np.testing.assert_allclose(uv, g.points[there], atol=1e-3)


def test_cuts_run_along_their_segments():
    a, g = sheet_atlas(13), grid_graph(TENS + 2, TENS + 2, 3, 0.3)
    cut = overlay(a, g)
    ends = g.points[g.segments[cut.cut_segment]]
    for k in (0, 1):
        t = cut.cut_param[:, [k]]
        v = cut.cuts[:, k]
        uv = interpolate(a.uv, a.F_uv, cut.vertex_face[v], cut.vertex_bary[v])
        np.testing.assert_allclose(uv, ends[:, 0] + t * (ends[:, 1] - ends[:, 0]), atol=1e-3)
    assert (cut.cut_param[:, 0] <= cut.cut_param[:, 1]).all()
    inside = ((g.points[g.segments] > 0) & (g.points[g.segments] < SIDE)).all(axis=(1, 2))
    covered = np.bincount(cut.cut_segment, np.diff(cut.cut_param)[:, 0], len(g.segments))
    np.testing.assert_allclose(covered[inside], 1, atol=1e-3)


def test_the_label_on_each_side_of_a_cut_is_the_outlines():
    a, g = sheet_atlas(13), grid_graph(TENS + 2, TENS + 2, 3, 0.3)
    cut = overlay(a, g)
    beside = {}
    for f, face in enumerate(cut.F.tolist()):
        for k in range(3):
            beside[face[k], face[(k + 1) % 3]] = cut.label[f]
    for (v, w), s in zip(cut.cuts.tolist(), cut.cut_segment.tolist(), strict=True):
        assert beside[v, w] == g.left[s]
        assert beside[w, v] == g.right[s]


def test_equal_input_gives_equal_output():
    a, g = two_charts(10, (30, 3.3)), grid_graph(WIDE, WIDE, 3, 0.3)
    one, other = overlay(a, g), overlay(a, g)
    for name in ("V", "F", "label", "region", "parent", "cuts", "vertex_bary"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def test_an_outline_that_ends_inside_the_mesh_is_refused():
    g = Outlines(np.array([[-5.0, 50], [50, 52]]), np.array([[0, 1]]), np.array([1]), np.array([2]))
    with pytest.raises(CutError, match="ends inside"):
        overlay(sheet_atlas(5), g)


def test_an_outline_that_ends_beyond_the_mesh_cuts_it():
    g = Outlines(np.array([[-5.0, 50], [105, 52]]), np.array([[0, 1]]), np.array([1]), np.array([2]))
    a = sheet_atlas(5)
    cut = overlay(a, g)
    assert_sound(a, cut)
    np.testing.assert_array_equal(
        cut.label == 1, midpoints_uv(a, cut)[:, 1] > 50 + (midpoints_uv(a, cut)[:, 0] + 5) / 55
    )


@settings(max_examples=80, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.integers(5, 60),
    st.integers(5, 60),
    st.sampled_from(["free", "grid", "mesh", "near"]),
    st.sampled_from([0.0, 1.0, 0.25]),
)
def test_any_mesh_and_any_planar_graph(seed, n_mesh, n_graph, kind, rounding):
    """Meshes and graphs are triangulations of random points, on lattices too, the graph's near the mesh's."""
    rng = np.random.default_rng(seed)

    def scatter(n):
        p = rng.uniform(0, 20, (n, 2))
        return np.unique(np.round(p / rounding) * rounding if rounding else p, axis=0)

    corners = np.array([[0, 0], [20, 0], [0, 20.0]])
    p = np.unique(np.concatenate([corners, scatter(n_mesh)]), axis=0)
    F = delaunay(p)
    used = np.unique(F)
    p, F = p[used], np.searchsorted(used, F)
    q = {"free": rng.uniform(-3, 23, (n_graph, 2)), "grid": scatter(n_graph), "mesh": p, "near": None}[kind]
    if q is None:
        q = p + 10.0 ** rng.uniform(-6, -1) * rng.normal(size=p.shape)
    g, T, label = patches(np.unique(np.concatenate([corners, q]), axis=0), 4, rng)
    a = atlas(np.column_stack([p, np.sin(p).sum(axis=1)]), F, p)
    cut = overlay(a, g)
    assert_sound(a, cut)

    at = midpoints_uv(a, cut)
    inside, triangle = shapely.STRtree(shapely.polygons(g.points[T])).query(
        shapely.points(at), predicate="intersects"
    )
    expected = np.full(len(at), -1)
    expected[inside] = label[triangle]
    clear = clear_of(g, at, 0.01)
    np.testing.assert_array_equal(cut.label[clear], expected[clear])
