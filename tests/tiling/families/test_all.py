"""Every family covers the plane once, with tiles of mean area 1 that hold on to each other."""

import numpy as np
import pytest
import shapely

from meshjig.tiling.check_unit import check_unit, locked_edges
from meshjig.tiling.registry import family_names, get_family
from meshjig.tiling.unit import edge_curves
from tests.tiling.tilings import cover_counts, outlines

NAMES = [name for name, _ in family_names() if "nn" not in name and "FILE" not in name]
NAMES += ["isohedral:IH01", "isohedral:IH28", "isohedral:IH38", "isohedral:IH81"]


@pytest.mark.parametrize("name", NAMES)
def test_copies_cover_the_plane_once(name):
    unit = get_family(name, seed=3)
    assert (cover_counts(unit) == 1).all()


@pytest.mark.parametrize("name", NAMES)
def test_units_pass_their_check_and_have_tiles_of_mean_area_1(name):
    unit = get_family(name, seed=3)
    check_unit(unit)
    assert np.mean([shapely.Polygon(tile).area for tile in outlines(unit)]) == pytest.approx(1.0)


def every_tile_holds_on(unit):
    return set(range(unit.n_tiles)) == set(unit.sides[locked_edges(unit)][..., 0].ravel().tolist())


@pytest.mark.parametrize("name", [name for name in NAMES if "escher" not in name])
def test_every_tile_with_knobs_holds_on_to_a_neighbour(name):
    assert every_tile_holds_on(get_family(name, seed=3))


def test_three_figures_or_more_hold_on_to_a_neighbour():
    figures = [name for name in NAMES if "escher" in name]
    assert sum(every_tile_holds_on(get_family(name)) for name in figures) >= 3


@pytest.mark.parametrize("name", NAMES)
def test_equal_seeds_give_equal_tilings(name):
    first, second = (edge_curves(get_family(name, seed=5)) for _ in range(2))
    assert all(np.array_equal(a, b) for a, b in zip(first, second, strict=True))
