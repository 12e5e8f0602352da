"""Poles are closed by wedges or a capstone: whole pieces, in agreement with the ring, without thin places."""

import numpy as np
import pytest
import shapely

from meshjig.cut import overlay
from meshjig.mesh.components import components
from meshjig.tiling import TileStyle, chart_polygons, squares, tile_charts, tile_surface
from meshjig.tiling.domain import chart_periods, unrolled
from meshjig.tiling.families.regular import hexagons
from meshjig.tiling.poles.poles import cap_border, find_poles
from meshjig.tiling.template import classic
from tests.tiling.charts import cup, flat_chart, ring_chart
from tests.tiling.test_periodic import unrolled_knobs
from tests.tiling.units import bricks, waves

UNITS = {"classic": squares(classic), "hex": hexagons(), "bricks": bricks(), "waves": waves()}
POLE = np.array([0.0, -100.0])
NECK = 2.0
# size of a tile on a cup of 25 mm: how many tiles across the floor is
LARGE, MIDDLE, SMALL = 40.0, 25.0, 11.0


@pytest.fixture(scope="module")
def atlas():
    return cup()


def at_pole(cut):
    """The regions around the pole, by the cut mesh."""
    top = np.flatnonzero(np.linalg.norm(cut.V, axis=1) < 0.01)
    return np.unique(cut.region[np.isin(cut.F, top).any(1)])


def drawn_in_cap(atlas, outlines, beyond=0.0):
    """The tiles of the floor as polygons, with as much of the ring as there is straight beyond, mm."""
    floor = chart_polygons(atlas)[1]
    ends = outlines.points[outlines.segments]
    ends = ends[shapely.intersects(floor, shapely.linestrings(ends))]
    away = ends - POLE
    out = np.hypot(away[..., 0], away[..., 1]).max(1)
    last = ends[out > 25.5]  # spokes end a little beyond the floor
    spokes = np.stack([last[:, 1], POLE + (last[:, 1] - POLE) * (26 + beyond) / 25], 1)
    rim = shapely.Polygon(POLE + (np.array(floor.exterior.coords) - POLE) * (25 + beyond) / 25)
    lines = [*shapely.linestrings(ends), *shapely.linestrings(spokes), rim.exterior]
    cells = shapely.get_parts(shapely.polygonize([shapely.union_all(lines)]))
    return [cell for cell in cells if rim.contains(cell.buffer(-1e-6))]


@pytest.mark.parametrize("chart", [ring_chart(), flat_chart()], ids=["open ring", "sheet"])
def test_what_no_chart_closes_has_no_pole(chart):
    assert find_poles(chart) == []
    tiling, plain = tile_surface(chart, 14.0, pole="wedge"), tile_charts(chart, 14.0)
    assert not tiling.poles
    np.testing.assert_array_equal(tiling.outlines.points, plain[0].points)


def test_a_cap_is_found_edge_by_edge(atlas):
    (pole,) = find_poles(atlas)
    assert (pole.cap, pole.ring, pole.tip) == (1, 0, None)
    away = pole.here - POLE
    np.testing.assert_allclose(np.hypot(away[..., 0], away[..., 1]), 25.0)
    turn = -np.arctan2(away[..., 1], away[..., 0])  # seen from below
    turn_there = 2 * np.pi * pole.there[..., 0] / atlas.period[0]
    np.testing.assert_allclose(np.exp(1j * turn), np.exp(1j * turn_there), atol=1e-6)
    np.testing.assert_array_equal(pole.here[:, 1], np.roll(pole.here[:, 0], -1, 0))


def test_a_pointed_cap_has_its_pole_at_the_tip():
    V = cup().mesh.V.copy()
    inner = V[:, 2] == 0
    V[inner, 2] -= 3 * (25 - np.hypot(V[inner, 0], V[inner, 1]))
    flat = cup()
    pointed = type(flat)(
        type(flat.mesh)(V, flat.mesh.F), flat.uv, flat.F_uv, flat.chart_of_face, {}, flat.period
    )
    (pole,) = find_poles(pointed)
    np.testing.assert_allclose(pole.tip, POLE, atol=1e-9)


def test_the_rim_names_each_tile_of_the_ring_once(atlas):
    (pole,) = find_poles(atlas)
    outlines, _ = tile_charts(atlas, MIDDLE, placings=None)
    rim = cap_border(pole, outlines, 3.0)
    assert len(rim.tile) == len(np.unique(rim.tile)) == 6  # 157 mm around
    gaps = np.linalg.norm(rim.start - np.roll(rim.start, 1, 0), axis=1)
    np.testing.assert_allclose(gaps, 25.0, atol=0.5)


@pytest.mark.parametrize("name", ["classic", "hex", "waves"])
@pytest.mark.parametrize("random", [0.0, 0.7])
def test_wedges_are_the_rings_tiles_run_on_to_the_pole(atlas, name, random):
    tiling = tile_surface(
        atlas, MIDDLE, pole="wedge", unit=UNITS[name], style=TileStyle(min_neck=NECK, random=random)
    )
    cut = overlay(atlas, tiling.outlines)
    assert cut.facts.label_conflicts == 0
    (fact,) = tiling.poles
    assert fact.closed_by == "wedge"
    assert fact.why == ""
    around = at_pole(cut)
    assert 2 <= len(around) == fact.meeting <= 8
    chart = atlas.chart_of_face[cut.parent]
    for region in around:
        assert set(chart[cut.region == region].tolist()) == {0, 1}
        assert components(cut.F[cut.region == region])[0] == 1
    assert set(cut.region[chart == 1].tolist()) == set(around.tolist())


def test_cuts_go_on_over_the_border_of_the_cap(atlas):
    tiling = tile_surface(atlas, MIDDLE, pole="wedge", style=TileStyle(min_neck=NECK))
    wedges = overlay(atlas, tiling.outlines)
    plain = overlay(atlas, tile_charts(atlas, MIDDLE, min_neck=NECK)[0])
    assert wedges.facts.seam_merged == plain.facts.seam_merged + 6


@pytest.mark.parametrize(
    ("style", "size"),
    [("wedge", SMALL), ("wedge", 17.0), ("wedge", MIDDLE), ("capstone", MIDDLE), ("capstone", 31.0)],
)
def test_nothing_is_thinner_than_a_neck_but_the_tip(atlas, style, size):
    tiling = tile_surface(atlas, size, pole=style, style=TileStyle(min_neck=NECK))
    assert tiling.poles[0].closed_by == style
    for cell in drawn_in_cap(atlas, tiling.outlines, beyond=(30 - size / 2) % size):
        inner = cell.buffer(-0.49 * NECK)
        assert inner.geom_type == "Polygon"
        assert not inner.is_empty


@pytest.mark.parametrize("size", [SMALL, MIDDLE, LARGE])
def test_no_knob_is_near_the_point(atlas, size):
    tiling = tile_surface(atlas, size, pole="wedge", style=TileStyle(min_neck=NECK))
    away = np.linalg.norm(tiling.outlines.points - POLE, axis=1)
    for first, after in tiling.knobs.span:
        assert away[tiling.outlines.segments[first:after]].min() > 0.25 * min(25.0, size)


@pytest.mark.parametrize("random", [0.0, 0.7])
@pytest.mark.parametrize("name", ["classic", "hex", "bricks"])
@pytest.mark.parametrize("style", ["wedge", "capstone", None])
def test_no_knob_leaves_its_chart_nor_holds_the_pole(atlas, style, name, random):
    polygons = [
        unrolled(polygon, period).buffer(-0.02 * MIDDLE)
        for polygon, period in zip(chart_polygons(atlas), chart_periods(atlas), strict=True)
    ]
    tiling = tile_surface(
        atlas, MIDDLE, pole=style, unit=UNITS[name], style=TileStyle(min_neck=NECK, random=random)
    )
    curves = list(unrolled_knobs(tiling.outlines, tiling.knobs))
    assert len(curves) > 10
    for curve in curves:
        line = shapely.LineString(curve)
        assert any(polygon.contains_properly(line) for polygon in polygons)
        if style:
            assert not shapely.Polygon(curve).contains(shapely.Point(POLE))


def test_where_too_many_would_meet_a_few_do_and_the_reason_is_given(atlas):
    tiling = tile_surface(atlas, SMALL, pole="wedge", style=TileStyle(min_neck=NECK))
    (fact,) = tiling.poles
    assert fact.why == "14 wedges would meet"
    assert 4 <= fact.meeting <= 8
    cut = overlay(atlas, tiling.outlines)
    assert len(at_pole(cut)) == fact.meeting
    assert cut.facts.label_conflicts == 0


def test_rows_around_a_pole_hold_tiles_of_one_size(atlas):
    size = 7.0
    tiling = tile_surface(atlas, size, pole="wedge", style=TileStyle(min_neck=1.0))
    areas = np.array([cell.area for cell in drawn_in_cap(atlas, tiling.outlines)])
    own = areas[areas > 0.6 * size**2]  # the rest belong to tiles of the ring
    assert len(own) > 20
    assert own.max() < 1.5 * size**2
    assert own.std() / own.mean() < 0.25


def test_a_capstone_is_one_piece_with_knobs_around(atlas):
    tiling = tile_surface(atlas, MIDDLE, pole="capstone", style=TileStyle(min_neck=NECK))
    assert tiling.poles[0].closed_by == "capstone"
    cut = overlay(atlas, tiling.outlines)
    (stone,) = at_pole(cut)
    mine = cut.region == stone
    assert set(atlas.chart_of_face[cut.parent[mine]].tolist()) == {1}
    away = np.linalg.norm(tiling.outlines.points - POLE, axis=1)
    knobs = [away[tiling.outlines.segments[a:b]].max() < 25 for a, b in tiling.knobs.span]
    assert sum(knobs) >= 3
    others = cut.region[(atlas.chart_of_face[cut.parent] == 1) & ~mine]
    assert len(np.unique(others)) == 6


def test_a_cap_smaller_than_a_tile_is_the_capstone_whole():
    atlas = cup(radius=10.0)
    tiling = tile_surface(atlas, 27.0, pole="capstone", style=TileStyle(min_neck=NECK))
    cut = overlay(atlas, tiling.outlines)
    (stone,) = at_pole(cut)
    assert set(cut.region[atlas.chart_of_face[cut.parent] == 1].tolist()) == {stone}
    assert set(cut.label[cut.region == stone].tolist()) == set(tiling.capstones.tolist())


def test_a_cap_too_large_for_a_capstone_is_tiled_as_ever(atlas):
    tiling = tile_surface(atlas, SMALL, pole="capstone", style=TileStyle(min_neck=NECK))
    assert tiling.poles[0].closed_by == "tiles"
    outlines, _ = tile_charts(atlas, SMALL, min_neck=NECK)
    np.testing.assert_array_equal(tiling.outlines.points, outlines.points)
