"""Tiles cover their chart, interlock, and keep their knobs inside it."""

import numpy as np
import pytest
import shapely

from meshjig.tiling import FAMILIES, chart_polygons, place_grid, tile_charts
from meshjig.types import Atlas, Mesh


def flat_chart(n=40, size=100.0, corner_cut=False):
    """A square sheet, or one without its upper right quarter."""
    x = np.linspace(0, size, n + 1)
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    keep = ~((i >= n / 2) & (j >= n / 2)) if corner_cut else np.ones_like(i, bool)
    a = (i * (n + 1) + j)[keep]
    F = np.concatenate([np.stack([a, a + n + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + 1], 1)])
    uv = np.stack(np.meshgrid(x, x, indexing="ij"), -1).reshape(-1, 2)
    used, F = np.unique(F, return_inverse=True)
    F, uv = F.reshape(-1, 3), uv[used]
    return Atlas(Mesh(np.c_[uv, np.zeros(len(uv))], F), uv, F, np.zeros(len(F), np.int64))


def knob_curves(outlines, knobs):
    for first, after in knobs.span:
        ids = np.append(outlines.segments[first:after, 0], outlines.segments[after - 1, 1])
        yield outlines.points[ids]


def test_polygon_of_a_chart_is_its_outline():
    square, notched = chart_polygons(flat_chart()), chart_polygons(flat_chart(corner_cut=True))
    assert square[0].area == pytest.approx(100**2)
    assert notched[0].area == pytest.approx(0.75 * 100**2)
    assert len(square) == 1


@pytest.mark.parametrize("family", sorted(FAMILIES))
@pytest.mark.parametrize("corner_cut", [False, True])
def test_faces_of_the_tiling_cover_the_chart_with_one_tile_each(family, corner_cut):
    atlas = flat_chart(corner_cut=corner_cut)
    outlines, _ = tile_charts(atlas, 13.0, family=family)
    chart = chart_polygons(atlas)[0]
    lines = shapely.linestrings(outlines.points[outlines.segments])
    cells = shapely.polygonize([shapely.node(shapely.union_all([*lines, chart.exterior]))])
    cells = shapely.get_parts(shapely.intersection(shapely.get_parts(cells), chart))
    assert shapely.area(cells).sum() == pytest.approx(chart.area)
    whole = np.abs(shapely.area(cells) / 13.0**2 - 1) < 0.45
    assert whole.sum() > 25


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_cuts_meet_at_shared_points_only(family):
    outlines, _ = tile_charts(flat_chart(), 13.0, family=family)
    lines = shapely.linestrings(outlines.points[outlines.segments])
    a, b = shapely.STRtree(lines).query(lines, predicate="intersects")
    shared = (outlines.segments[a][:, :, None] == outlines.segments[b][:, None, :]).any((1, 2))
    assert shared.all()


@pytest.mark.parametrize("family", sorted(FAMILIES))
@pytest.mark.parametrize("corner_cut", [False, True])
def test_knobs_stay_off_the_border(family, corner_cut):
    atlas = flat_chart(corner_cut=corner_cut)
    outlines, knobs = tile_charts(atlas, 13.0, family=family)
    inside = chart_polygons(atlas)[0]
    shapely.prepare(inside)
    assert len(knobs.span) > 50
    assert all(inside.contains_properly(shapely.LineString(curve)) for curve in knob_curves(outlines, knobs))


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_heads_are_wider_than_necks_and_belong_to_the_knob(family):
    outlines, knobs = tile_charts(flat_chart(), 13.0, family=family)
    width = {
        name: np.linalg.norm(np.diff(outlines.points[points], axis=1)[:, 0], axis=1)
        for name, points in (("neck", knobs.neck), ("head", knobs.head))
    }
    assert (width["head"] / width["neck"]).min() > 1.5
    for curve, neck, head in zip(knob_curves(outlines, knobs), knobs.neck, knobs.head, strict=True):
        np.testing.assert_array_equal(curve[[0, -1]], outlines.points[neck])
        assert (curve[:, None] == outlines.points[head]).all(2).any(0).all()


def test_labels_are_the_tiles_on_the_named_side():
    atlas = flat_chart()
    outlines, _ = tile_charts(atlas, 13.0, family="rectangular", shift=(0.25, 0.0))
    grid = place_grid(chart_polygons(atlas)[0], 13.0, (0.25, 0.0))
    a, b = outlines.points[outlines.segments[:, 0]], outlines.points[outlines.segments[:, 1]]
    normal = np.stack([a[:, 1] - b[:, 1], b[:, 0] - a[:, 0]], 1)
    flat = np.abs((b - a) / np.linalg.norm(b - a, axis=1)[:, None]).max(1) > 0.9999
    straight = flat & (np.minimum((a - grid.origin) % 13.0, 13.0 - (a - grid.origin) % 13.0).min(1) < 0.2)
    for sign, label in ((1, outlines.left), (-1, outlines.right)):
        point = (a + b) / 2 + sign * 2.0 * normal / np.linalg.norm(normal, axis=1)[:, None]
        cell = np.floor((point - grid.origin) / 13.0).astype(int)
        np.testing.assert_array_equal(label[straight], (cell[:, 0] * grid.shape[1] + cell[:, 1])[straight])
    assert straight.sum() > 100


def test_seed_decides():
    first, again, other = (tile_charts(flat_chart(), 13.0, seed=s)[0].points for s in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert first.shape != other.shape or not np.allclose(first, other)


def test_knobs_do_not_shrink_below_the_least_neck():
    atlas = flat_chart(size=55.0)
    _, free = tile_charts(atlas, 13.0)
    outlines, bound = tile_charts(atlas, 13.0, min_neck=13.0 * FAMILIES["classic"](8).neck_width - 1e-6)
    neck = np.linalg.norm(np.diff(outlines.points[bound.neck], axis=1)[:, 0], axis=1)
    assert len(bound.neck) < len(free.neck)
    assert neck.min() > 0.98 * 13.0 * FAMILIES["classic"](8).neck_width
