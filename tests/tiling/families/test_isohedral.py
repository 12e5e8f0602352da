"""Each isohedral type is one tile, turned and mirrored; those that can't interlock are refused."""

import sys

import numpy as np
import pytest
import shapely

from meshjig.errors import OptionError
from meshjig.tiling.check_unit import check_unit
from meshjig.tiling.families.isohedral import STRAIGHT, isohedral
from meshjig.tiling.interlock import locked_edges
from tests.tiling.tilings import is_moved, outlines

tactile = pytest.importorskip("tactile")
TYPES = [k for k in tactile.tiling_types if k not in STRAIGHT]


@pytest.mark.parametrize("number", TYPES)
def test_tiles_are_one_tile_turned_and_mirrored_that_locks(number):
    unit = isohedral(f"IH{number:02d}")
    check_unit(unit)
    first, *others = outlines(unit)
    assert all(is_moved(first, other, mirrored=True) for other in others)
    assert locked_edges(unit).any()


@pytest.mark.parametrize("number", TYPES)
def test_tiles_stay_whole_when_walls_are_thinned(number):
    tile = shapely.Polygon(outlines(isohedral(f"IH{number:02d}"))[0])
    assert tile.buffer(-0.024).geom_type == "Polygon"
    assert tile.buffer(-0.024).area > 0.75


def test_types_left_out_are_those_with_straight_edges_only():
    straight = [
        k
        for k in tactile.tiling_types
        if all(shape.shape.name == "I" for shape in tactile.IsohedralTiling(k).shapes)
    ]
    assert tuple(straight) == STRAIGHT
    for number in STRAIGHT:
        with pytest.raises(OptionError, match=f"IH{number}.*straight"):
            isohedral(f"IH{number}")


@pytest.mark.parametrize("name", ["IH19", "IH94", "IH0", "14", "IHxx", ""])
def test_other_names_are_refused(name):
    with pytest.raises(OptionError):
        isohedral(name)


def test_leading_zeros_and_case_do_not_matter():
    assert all(
        np.array_equal(a, b) for a, b in zip(isohedral("ih4").curves, isohedral("IH04").curves, strict=True)
    )


def test_missing_package_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "tactile", None)
    with pytest.raises(OptionError, match=r"tactile.*pip install meshjig\[isohedral\]"):
        isohedral("IH04")


def test_seed_turns_knobs_the_other_way():
    first = {isohedral("IH41", seed).curves[0].tobytes() for seed in range(8)}
    assert len(first) > 1
