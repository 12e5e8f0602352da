"""On a periodic chart tiles and knobs go on over the closing line, all the way round."""

import numpy as np
import pytest
import shapely

from meshjig.tiling import chart_polygons, squares, tile_charts
from meshjig.tiling.domain import unrolled
from meshjig.tiling.template import classic, rectangular
from tests.tiling.charts import flat_chart, ring_chart
from tests.tiling.units import bricks, waves

UNITS = {
    "classic": squares(classic),
    "rectangular": squares(rectangular),
    "bricks": bricks(),
    "waves": waves(),
}
PERIOD = 157.0
RANDOM = [(0.0, "bspline"), (0.7, "bspline"), (0.7, "bilinear")]


@pytest.fixture(scope="module")
def chart():
    return ring_chart(PERIOD)


def same(outlines):
    assert outlines.same_point is not None
    assert outlines.same_segment is not None
    return outlines.same_point, outlines.same_segment


@pytest.mark.parametrize("random", RANDOM, ids=str)
@pytest.mark.parametrize("name", sorted(UNITS))
def test_copies_are_exact_translates_of_the_first(chart, name, random):
    outlines, _ = tile_charts(chart, 14.0, unit=UNITS[name], random=random[0], random_style=random[1])
    point, segment = same(outlines)
    off = outlines.points - outlines.points[point]
    assert set((off[:, 0] / PERIOD).tolist()) == {-1.0, 0.0, 1.0}
    assert not off[:, 1].any()
    assert (point <= np.arange(len(point))).all()
    assert (point[point] == point).all()
    np.testing.assert_array_equal(point[outlines.segments], point[outlines.segments[segment]])
    np.testing.assert_array_equal(outlines.left, outlines.left[segment])
    np.testing.assert_array_equal(outlines.right, outlines.right[segment])
    assert (segment != np.arange(len(segment))).any()


@pytest.mark.parametrize("random", RANDOM, ids=str)
@pytest.mark.parametrize("name", sorted(UNITS))
def test_both_sides_of_the_closing_line_have_the_same_cuts_and_tiles(chart, name, random):
    outlines, _ = tile_charts(chart, 14.0, unit=UNITS[name], random=random[0], random_style=random[1])
    v = np.linspace(0.5, 79.5, 200)
    line = np.stack([6 * np.sin(7 * v / 80), v], 1)
    ways = [crossed(outlines, line + np.array([by, 0.0])) for by in (0.0, PERIOD)]
    assert len(ways[0]) > 3
    assert [tiles for _, tiles in ways[0]] == [tiles for _, tiles in ways[1]]
    np.testing.assert_allclose([at for at, _ in ways[0]], [at for at, _ in ways[1]], atol=1e-9)


def crossed(outlines, line):
    """List where a line meets cuts, and the tiles on their sides."""
    path = shapely.LineString(line)
    cuts = shapely.linestrings(outlines.points[outlines.segments])
    found = []
    for s in shapely.STRtree(cuts).query(path, predicate="crosses").tolist():
        tiles = int(outlines.left[s]), int(outlines.right[s])
        found += [(path.project(p), tiles) for p in shapely.get_parts(path.intersection(cuts[s]))]
    return sorted(found)


@pytest.mark.parametrize("random", RANDOM, ids=str)
@pytest.mark.parametrize("name", ["classic", "rectangular", "bricks"])
def test_knobs_cross_the_closing_line_but_no_rim(chart, name, random):
    unit, (amount, style) = UNITS[name], random
    polygon = chart_polygons(chart)[0]
    inside = shapely.buffer(unrolled(polygon, PERIOD), -0.04 * 14.0)
    crossing = 0
    for seed in range(4):  # where the line runs among the tiles is left to chance
        outlines, knobs = tile_charts(chart, 14.0, unit=unit, random=amount, random_style=style, seed=seed)
        for curve in map(shapely.LineString, unrolled_knobs(outlines, knobs)):
            assert inside.contains_properly(curve)
            crossing += not polygon.contains_properly(curve) and polygon.intersects(curve)
    assert crossing > 0


@pytest.mark.parametrize("name", ["classic", "rectangular", "bricks"])
def test_knobs_are_listed_once_and_whole(chart, name):
    outlines, knobs = tile_charts(chart, 14.0, unit=UNITS[name])
    point, segment = same(outlines)
    chosen = np.concatenate([np.arange(first, after) for first, after in knobs.span])
    assert len(np.unique(chosen)) == len(chosen)
    np.testing.assert_array_equal(segment[chosen], chosen)
    for pair in (knobs.neck, knobs.head):
        np.testing.assert_array_equal(point[pair], pair)
    curves = unrolled_knobs(outlines, knobs)
    for curve, (first, after), neck, head in zip(curves, knobs.span, knobs.neck, knobs.head, strict=True):
        assert point[outlines.segments[first, 0]] == neck[0]
        assert point[outlines.segments[after - 1, 1]] == neck[1]
        assert set(head.tolist()) <= set(point[outlines.segments[first:after].ravel()].tolist())
        np.testing.assert_array_equal(
            point[outlines.segments[first : after - 1, 1]], point[outlines.segments[first + 1 : after, 0]]
        )
        assert len(curve) == after - first + 1


def unrolled_knobs(outlines, knobs):
    """Draw every knob in one piece, from steps that may lie a period apart."""
    for first, after in knobs.span:
        a, b = (outlines.points[outlines.segments[first:after, k]] for k in (0, 1))
        yield np.concatenate([a[:1], a[:1] + np.cumsum(b - a, axis=0)])


@pytest.mark.parametrize("size", [9.0, 14.0])
@pytest.mark.parametrize("name", sorted(UNITS))
def test_tiles_keep_their_area(chart, name, size):
    outlines, _ = tile_charts(chart, size, unit=UNITS[name])
    lines = shapely.union_all(shapely.linestrings(outlines.points[outlines.segments]))
    cells = shapely.get_parts(shapely.polygonize([lines]))
    inner = cells[shapely.contains(shapely.box(10, 1, PERIOD - 10, 79), cells)]
    assert len(inner) > 25
    assert shapely.area(inner).sum() / len(inner) == pytest.approx(size**2, rel=0.1)


@pytest.mark.parametrize("period", [14.0, 24.0, 33.0])
def test_a_thin_limb_has_rings_or_few_tiles_around(period):
    outlines, _ = tile_charts(ring_chart(period, wiggle=1.0), 20.0)
    assert (outlines.left != outlines.right).all()
    assert len(np.unique(np.append(outlines.left, outlines.right))) > 3


def test_an_atlas_without_a_period_names_no_copies():
    outlines, _ = tile_charts(flat_chart(), 14.0)
    assert outlines.same_point is None
    assert outlines.same_segment is None
