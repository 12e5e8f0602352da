"""Figures interlock by their outlines, can be printed, and their inner lines stay inside."""

import tomllib
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
import shapely
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from meshjig.errors import OptionError
from meshjig.tiling.assemble_unit import assemble
from meshjig.tiling.check_unit import check_unit, locked_edges
from meshjig.tiling.families import escher
from tests.tiling.tilings import copies, cover_counts, is_moved, outlines

DIRECTIONS = np.linspace(0, 2 * np.pi, 72, endpoint=False)
NARROWEST = 0.10  # of a tile's edge
HOLD = 0.03  # of a tile's edge; 0.2 mm are that much of a tile of 7 mm


@pytest.fixture(params=escher.names())
def name(request):
    return request.param


def test_there_are_at_least_three_figures_with_a_lizard_among_them():
    assert len(set(escher.names())) >= 3
    assert "lizard" in escher.names()


def test_every_figure_has_a_file_and_each_file_is_a_figure():
    kept = {path.name for path in (files("meshjig.tiling.families") / "figures").iterdir()}
    assert kept == {f"{name}.json" for name in escher.names()}


def test_figures_are_packed_with_the_package():
    project = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text())
    assert "figures/*.json" in project["tool"]["setuptools"]["package-data"]["meshjig.tiling.families"]


def test_figures_cover_the_plane_once(name):
    unit = escher.unit(name)
    check_unit(unit)
    assert (cover_counts(unit) == 1).all()


def test_all_tiles_are_one_figure(name):
    first, *others = outlines(escher.unit(name))
    assert all(is_moved(first, other, mirrored=True, tolerance=1e-3) for other in others)


def test_a_tile_overlaps_its_neighbours_wherever_it_is_moved(name):
    unit = escher.unit(name)
    around = copies(unit)
    for tile in map(shapely.Polygon, outlines(unit)):
        others = [other for other in around if other.centroid.distance(tile.centroid) > 1e-3]
        beside = shapely.union_all([other for other in others if other.distance(tile) < 1e-6])
        for angle in DIRECTIONS:
            moved = shapely.affinity.translate(tile, 0.01 * np.cos(angle), 0.01 * np.sin(angle))
            assert moved.intersection(beside).area > 0.01 * 0.25


def slides_apart(unit):
    """Whether in some direction part of a patch of tiles can move off without taking the rest along.

    Tile a takes b along where moving a alone would make it overlap b. A patch holds if from any tile
    near its middle any other is reached that way, those behind it too. For the opposite direction
    the graph is the same, read backwards: half of the directions tell all.
    """
    middle = shapely.Point(np.mean([tile.mean(0) for tile in outlines(unit)], axis=0))
    tiles = [tile.simplify(0.002) for tile in copies(unit) if tile.distance(middle) < 2.6]
    near = np.array([tile.distance(middle) < 1.2 for tile in tiles])
    a, b = shapely.STRtree(tiles).query([tile.buffer(0.01) for tile in tiles], predicate="intersects")
    a, b = a[a != b], b[a != b]
    tiles = np.array(tiles)
    for angle in DIRECTIONS[: len(DIRECTIONS) // 2]:
        step = 0.02 * np.array([np.cos(angle), np.sin(angle)])
        moved = shapely.transform(tiles, lambda points, step=step: points + step)
        takes = shapely.area(shapely.intersection(moved[a], tiles[b])) > 5e-4
        graph = coo_matrix((np.ones(takes.sum()), (a[takes], b[takes])), (len(tiles),) * 2)
        part = connected_components(graph, directed=True, connection="strong")[1]
        if len(set(part[near])) > 1:
            return True
    return False


def test_no_part_of_the_puzzle_slides_off_the_rest(name):
    assert not slides_apart(escher.unit(name))


def test_squares_with_plain_edges_slide_apart():
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]])
    assert slides_apart(assemble([[corners[k : k + 2] for k in range(4)]], np.eye(2)))


def test_every_tile_holds_on_to_a_neighbour_by_itself(name):
    unit = escher.unit(name)
    assert set(unit.sides[locked_edges(unit)][..., 0].ravel()) == set(range(unit.n_tiles))


def undercut(curve):
    """How far a border has to give way, at least, for the tiles on its sides to come apart."""
    along = curve @ np.stack([np.cos(DIRECTIONS), np.sin(DIRECTIONS)])
    return (np.maximum.accumulate(along, axis=0) - along).max(0).min()


def test_every_tile_holds_on_to_a_neighbour_by_more_than_the_gap_between_printed_pieces(name):
    unit = escher.unit(name)
    holds = np.array([undercut(curve) for curve in unit.curves]) > HOLD
    assert set(unit.sides[holds][..., 0].ravel()) == set(range(unit.n_tiles))


def test_figures_are_nowhere_too_narrow_to_print(name):
    """A disc as wide as the narrowest part can go all over a tile, but for pointed ends."""
    for tile in map(shapely.Polygon, outlines(escher.unit(name))):
        core = tile.buffer(-NARROWEST / 2)
        assert core.geom_type == "Polygon"
        assert tile.difference(core.buffer(NARROWEST / 2)).area < 0.01
        assert core.buffer(1.2 * NARROWEST).contains(tile)


def test_curves_have_evenly_spaced_points(name):
    for curve in escher.unit(name).curves:
        steps = np.linalg.norm(np.diff(curve, axis=0), axis=1)
        assert steps.max() < 0.03
        assert steps.min() > 0.5 * steps.max()


def test_inner_lines_lie_inside_their_tile(name):
    unit = escher.unit(name)
    drawn = escher.decor(name)
    assert len(drawn) == unit.n_tiles
    for tile, lines in zip(map(shapely.Polygon, outlines(unit)), drawn, strict=True):
        assert len(lines) > 0
        assert all(tile.contains_properly(shapely.LineString(line)) for line in lines)


def test_names_that_are_no_figure_are_refused():
    with pytest.raises(OptionError, match="no figure 'unicorn'"):
        escher.unit("unicorn")
    with pytest.raises(OptionError, match="no figure 'unicorn'"):
        escher.decor("unicorn")
