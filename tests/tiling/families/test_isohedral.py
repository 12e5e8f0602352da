"""Each isohedral type is one tile, turned and mirrored; those that can't interlock are refused."""

import re
import sys

import numpy as np
import pytest
import shapely

from meshjig.errors import OptionError
from meshjig.tiling.check_unit import check_unit, locked_edges
from meshjig.tiling.families.isohedral import STRAIGHT, isohedral
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


WAVE = "M 10,20 C 20,20 25,8 32,8 C 42,8 40,22 30,22 C 26,22 30,26 50,20"  # hooked, without symmetry
FLAT_KNOB = "M 0,0 H 40 C 30,-20 70,-20 60,0 H 100"  # a mirror image of itself


def drawn(tmp_path, *paths, transform="translate(5,3) rotate(20) scale(1.5)"):
    body = "".join(f'<path d="{d}"/>' for d in paths)
    file = tmp_path / "edge.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="50mm" viewBox="0 0 160 100">'
        f'<g transform="{transform}"><g>{body}</g></g></svg>'
    )
    return file


@pytest.mark.parametrize("number", [1, 2, 7, 12, 28, 43, 46, 62, 73])
def test_edges_of_ones_own_make_tiles_that_are_one_tile(number, tmp_path):
    unit = isohedral(f"IH{number}:{drawn(tmp_path, WAVE)}")
    check_unit(unit)
    first, *others = outlines(unit)
    assert all(is_moved(first, other, mirrored=True) for other in others)
    assert locked_edges(unit).any()


def test_where_and_how_large_an_edge_is_drawn_does_not_matter(tmp_path):
    one = isohedral(f"IH41:{drawn(tmp_path, WAVE)}")
    other = isohedral(f"IH41:{drawn(tmp_path, WAVE, transform='scale(0.2)')}")
    for a, b in zip(one.curves, other.curves, strict=True):
        np.testing.assert_allclose(a, b, atol=1e-6)


def test_a_symmetric_edge_stays_as_it_is_drawn(tmp_path):
    """Type 73 asks for edges that are mirror images of themselves: one knob stays one knob."""
    knob, wave = (isohedral(f"IH73:{drawn(tmp_path, d)}") for d in (FLAT_KNOB, WAVE))
    assert _off_middle(knob.curves[0]) == pytest.approx(0.15, abs=0.01)
    assert _off_middle(wave.curves[0]) == pytest.approx(0.0, abs=1e-6)  # on either half, one


def _off_middle(curve):
    """Tell how far from the middle of its ends a curve is halfway along it."""
    middle = shapely.LineString(curve).interpolate(0.5, normalized=True)
    return np.linalg.norm(np.array(middle.coords[0]) - (curve[0] + curve[-1]) / 2)


def test_two_paths_shape_the_edges_in_turn(tmp_path):
    both = isohedral(f"IH41:{drawn(tmp_path, WAVE, 'M 0,0 H 9')}")
    straight = [len(curve) == 2 for curve in both.curves]
    assert sorted(straight) == [False, True]


@pytest.mark.parametrize(
    ("d", "says", "at"),
    [
        ("M 10,20 H 30 V 40 Z", "closed", (10, 20)),
        ("M 0,0 H 30 V 20 H 10 V -10", "crosses", (10, 0)),
        ("M 0,0 C 10,-300 20,-300 30,0", "thinner", None),
    ],
    ids=["closed", "with a loop", "too high"],
)
def test_edges_that_will_not_do_are_refused(d, says, at, tmp_path):
    file = drawn(tmp_path, d, transform="translate(5,3)")
    with pytest.raises(OptionError, match=says) as error:
        isohedral(f"IH41:{file}")
    assert str(file) in str(error.value)
    if at is not None:
        found = [float(x) for x in re.search(r"\(([-\d.]+), ([-\d.]+)\)", str(error.value)).groups()]
        assert found == pytest.approx([at[0] + 5, at[1] + 3], abs=0.01)


def test_a_missing_file_is_named():
    with pytest.raises(OptionError, match=r"nowhere\.svg"):
        isohedral("IH41:nowhere.svg")
