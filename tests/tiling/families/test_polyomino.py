"""Polyominoes are whole, without holes, four squares on average, and close around any period."""

import numpy as np
import pytest
import shapely

from meshjig.tiling.families.polyomino import SQUARES, polyomino
from meshjig.tiling.unit import edge_ends, tile_outlines


def squares_of(unit):
    """The tiles with straight edges, in squares."""
    edges = edge_ends(unit)
    side = np.linalg.norm(edges[0, 1] - edges[0, 0])
    return [shapely.Polygon(tile / side) for tile in tile_outlines(unit, list(edges))]


@pytest.mark.parametrize("columns", [None, 3, 7, 40])
@pytest.mark.parametrize("seed", range(4))
def test_tiles_are_three_to_six_squares_without_holes(columns, seed):
    tiles = squares_of(polyomino(seed, columns))
    area = np.round([tile.area for tile in tiles], 6)
    assert np.array_equal(area, np.round(area))
    assert area.mean() == SQUARES
    assert area.max() <= 6
    assert (area >= 3).mean() > 0.75
    assert all(tile.is_valid and len(tile.interiors) == 0 for tile in tiles)


@pytest.mark.parametrize("columns", [1, 2, 3, 5, 11])
def test_first_translation_is_the_columns_asked_for(columns):
    unit = polyomino(2, columns)
    edges = edge_ends(unit)
    side = np.linalg.norm(edges[0, 1] - edges[0, 0])
    assert unit.translations[0] == pytest.approx([columns * side, 0.0])


@pytest.mark.parametrize("columns", [2, 3, 4])
def test_no_tile_meets_its_own_copy_on_a_narrow_ring(columns):
    unit = polyomino(1, columns)
    assert (unit.sides[:, 0, 0] != unit.sides[:, 1, 0]).all()


def test_every_straight_side_of_a_square_is_an_edge():
    lengths = np.linalg.norm(np.diff(edge_ends(polyomino(0)), axis=1), axis=2)
    assert np.ptp(lengths) < 1e-12


def test_seeds_differ():
    assert len(polyomino(0).ends) != len(polyomino(1).ends) or not np.array_equal(
        polyomino(0).sides, polyomino(1).sides
    )
