"""Tiles without knobs: laid, counted in and looked up."""

import numpy as np
import pytest
import shapely

from meshjig.tiling import Placing, TileShapes, squares
from meshjig.tiling.fit import bent_round
from meshjig.tiling.template import classic
from tests.tiling.units import bricks, waves

UNITS = {"squares": squares(classic), "bricks": bricks(), "waves": waves()}
BOX = np.array([0.0, 0.0, 71.0, 37.0])


def points(n):
    return np.random.default_rng(0).uniform(BOX[:2], BOX[2:], (n, 2))


@pytest.mark.parametrize("name", sorted(UNITS))
@pytest.mark.parametrize("angle", [0.0, 20.0])
def test_laid_tiles_cover_the_box_and_lines_divide_the_tiles_named(name, angle):
    laid = TileShapes(UNITS[name]).lay(Placing(9.0, angle, np.array([3.0, 5.0])), BOX, points(300))
    clipped = shapely.intersection(laid.tiles, shapely.box(*BOX))
    assert shapely.area(clipped).sum() == pytest.approx(71.0 * 37.0)
    assert len(np.unique(laid.of_tile)) == len(laid.tiles)
    tile = dict(zip(laid.of_tile.tolist(), laid.tiles, strict=True))
    inside = shapely.intersects(laid.lines, shapely.box(*BOX))
    for line, (left, right) in zip(laid.lines[inside], laid.of_side[inside].tolist(), strict=True):
        assert all(tile[t].exterior.buffer(1e-6).covers(line) for t in (left, right))
        a, b = line.interpolate([0.5, 0.5001], normalized=True)
        normal = 1e-2 * np.array([a.y - b.y, b.x - a.x]) / a.distance(b)
        assert tile[left].contains(shapely.Point(np.array([a.x, a.y]) + normal))


@pytest.mark.parametrize("name", sorted(UNITS))
def test_points_are_found_in_their_tile(name):
    shapes, placing, at = TileShapes(UNITS[name]), Placing(9.0, 20.0, np.array([3.0, 5.0])), points(4000)
    laid = shapes.lay(placing, BOX, at)
    tile = dict(zip(laid.of_tile.tolist(), laid.tiles, strict=True))
    inside = shapely.contains([tile[t] for t in laid.of_point.tolist()], shapely.points(at))
    assert inside.mean() > 0.95
    counts = shapes.counts(placing, at, np.zeros((1, 2)))[0]
    assert sorted(counts[counts > 0]) == sorted(np.unique(laid.of_point, return_counts=True)[1])


def test_shifts_move_the_tiling_back():
    shapes, at = TileShapes(bricks()), points(2000)
    shift = np.array([[0.3, 0.1], [0.75, 0.9]])
    counts = shapes.counts(Placing(9.0, 20.0), at, shift)
    for row, by in zip(counts, shift, strict=True):
        placing = Placing(9.0, 20.0)
        moved = Placing(9.0, 20.0, -by @ bricks().translations @ placing.matrix)
        alone = shapes.counts(moved, at, np.zeros((1, 2)))[0]
        assert sorted(row[row > 0]) == sorted(alone[alone > 0])


@pytest.mark.parametrize("name", sorted(UNITS))
def test_copies_a_period_away_are_one_tile(name):
    shapes, period = TileShapes(UNITS[name]), 50.0
    placing = bent_round(UNITS[name], 9.0, period)[0]
    at = points(200) * [0.25, 1.0]
    laid = shapes.lay(placing, BOX, np.concatenate([at, at + np.array([period, 0.0])]))
    np.testing.assert_array_equal(laid.of_point[:200], laid.of_point[200:])
    counts = shapes.counts(placing, points(5000), np.zeros((1, 2)))
    assert (counts > 0).sum() < 1.2 * (period + 9) * (37.0 + 18) / 81.0
