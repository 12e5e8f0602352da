"""On a periodic chart, what is drawn on both sides of the closing line is one on the surface."""

import numpy as np
import pytest
import shapely

from meshjig.cut.gap_bands import gap_outlines
from meshjig.cut.merge_periodic import merge_periodic
from meshjig.cut.overlay import overlay
from meshjig.cut.transfer_pieces import transfer_pieces
from meshjig.layout.interlock import interlock
from meshjig.layout.outer_gap import outer_gap
from meshjig.layout.stitch import region_graph
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import GAP
from tests.cut.graphs import assert_sound, ring_graph, tube_atlas

WIDTH, HEIGHT, AROUND = 120.0, 80.0, 5
ROWS = np.array([-10.0, 26.0, 53.0, 90.0])
KNOBS_AT_THE_LINE = 2.0, -1.5, 0.0  # where columns begin: knobs reach over it, a side runs along it
TEETH = 0.0, 1.7


@pytest.fixture(scope="module", params=[(x, t) for x in KNOBS_AT_THE_LINE for t in TEETH])
def tiled(request):
    first, teeth = request.param
    atlas = tube_atlas(48, 32, WIDTH, HEIGHT, teeth)
    outlines, knobs = ring_graph(AROUND, ROWS, first, WIDTH)
    return atlas, outlines, knobs, overlay(atlas, outlines)


def test_tiles_over_the_closing_line_are_one_region_each(tiled):
    atlas, _, _, cut = tiled
    assert_sound(atlas, cut)
    assert len(np.unique(cut.label)) == len(np.unique(cut.region)) == 3 * AROUND
    graph = region_graph(cut)
    assert not graph.seam.any()


def test_tiles_around_the_ring_have_equal_areas(tiled):
    _, _, _, cut = tiled
    area = np.bincount(cut.label, face_areas(cut.V, cut.F)).reshape(3, AROUND)
    np.testing.assert_allclose(area, area.mean(1, keepdims=True).repeat(AROUND, 1), rtol=5e-3)


def test_cuts_from_both_sides_meet_on_the_closing_line(tiled):
    _, outlines, _, cut = tiled
    covered = np.zeros(int(outlines.same_segment.max()) + 1)
    np.add.at(covered, outlines.same_segment[cut.cut_segment], np.diff(cut.cut_param)[:, 0])
    inside = ((outlines.points[:, 1] > 0) & (outlines.points[:, 1] < HEIGHT))[outlines.segments].all(1)
    whole = np.unique(outlines.same_segment[inside])
    np.testing.assert_allclose(covered[whole], 1, atol=1e-6)
    degree = np.bincount(np.unique(np.sort(cut.cuts, axis=1), axis=0).ravel(), minlength=len(cut.V))
    inner = (cut.V[:, 2] > 1e-6) & (cut.V[:, 2] < HEIGHT - 1e-6)
    assert degree[inner & (degree > 0)].min() >= 2  # no cut ends on the way


def test_knobs_over_the_closing_line_are_whole_when_folded(tiled):
    _, outlines, knobs, cut = tiled
    found = interlock(merge_periodic(cut, outlines), knobs, cut.label)
    assert len(found.neck) == 3 * AROUND
    of_row = found.neck.reshape(AROUND, 3)
    np.testing.assert_allclose(of_row, of_row.mean(0)[None].repeat(AROUND, 0), rtol=0.02)
    assert len(interlock(cut, knobs, cut.label).neck) < 3 * AROUND


@pytest.mark.parametrize("method", ["stretch", "domain"])
def test_the_gap_is_complete_over_the_closing_line(tiled, method):
    atlas, outlines, _, cut = tiled
    clearance = 0.4
    parts = overlay(atlas, gap_outlines(atlas, cut, outlines, cut.label, clearance, method))
    piece, specks = transfer_pieces(cut, cut.label, parts)
    assert len(specks) == 0
    gap = outer_gap(parts.V, parts.F, piece, clearance)
    assert gap["within_10pct"] > 0.97
    area = _area_beside_the_line(parts.V, parts.F[piece == GAP])
    assert area == pytest.approx(_drawn_beside_the_line(outlines, clearance), rel=0.03)


BESIDE = shapely.box(-3, 0, 3, HEIGHT)


def _area_beside_the_line(V, F):
    """Unroll the tube about its closing line and measure what lies within 3 mm of it."""
    u = np.arctan2(V[:, 1], V[:, 0]) * WIDTH / (2 * np.pi)
    F = F[np.ptp(u[F], axis=1) < WIDTH / 2]
    flat = shapely.polygons(np.stack([u, V[:, 2]], 1)[F])
    return shapely.area(shapely.intersection(flat, BESIDE)).sum()


def _drawn_beside_the_line(outlines, clearance):
    """Draw the band in the plane alone, all copies of it, and measure it there."""
    inner = ~((outlines.left < 0) | (outlines.right < 0))
    lines = shapely.linestrings(outlines.points[outlines.segments[inner]])
    return shapely.intersection(shapely.union_all(shapely.buffer(lines, clearance / 2)), BESIDE).area


def test_outlines_without_copies_are_left_alone():
    atlas = tube_atlas()
    outlines, _ = ring_graph(AROUND, ROWS, 2.0, WIDTH)
    cut = overlay(atlas, outlines)
    plain = type(outlines)(outlines.points, outlines.segments, outlines.left, outlines.right)
    assert merge_periodic(cut, plain) is cut
