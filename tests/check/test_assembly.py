"""A plan that can't work is found, and what holds a piece is named."""

import json

import numpy as np
import pytest

from meshjig.check import AssemblyPlan, judge_assembly, overlaps
from meshjig.mesh.measure import mesh_volume
from meshjig.output.files.mesh_files import write_stl
from meshjig.pipeline.check_folder import check_folder
from tests.check.jigsaws import TILE, coupon, dovetail, ring
from tests.check.pieces import box
from tests.meshes import Shape, moved

UP = [0.0, 0.0, 1.0]
NAMES = [f"piece_{k + 1:03d}" for k in range(9)]


def planned(pieces, way=UP, **asked):
    names = NAMES[: len(pieces)]
    return AssemblyPlan(asked.pop("order", names), dict.fromkeys(names, way), **asked)


def turned_by(piece, degrees):
    """Turn a piece in the plane around its own middle."""
    t = np.radians(degrees)
    R = np.array([[np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1]])
    middle = (piece.V.min(axis=0) + piece.V.max(axis=0)) / 2
    return Shape((piece.V - middle) @ R.T + middle, piece.F)


def test_tiles_of_a_sheet_all_go_straight_in_along_its_normal():
    checks, failures = judge_assembly(coupon(), planned(coupon()))
    assert (checks.pieces, checks.proved, checks.straight) == (9, 9, 9)
    assert (checks.press_mm, checks.held_by, failures) == (0, {}, {})


def test_the_knobs_of_a_sheet_let_nothing_out_in_its_plane():
    checks, failures = judge_assembly(coupon(), planned(coupon(), [1.0, 0.0, 0.0]))
    right = [k for k in range(9) if k % 3]
    assert failures["assembly"] == [NAMES[k] for k in right]
    assert all(NAMES[k - 1] in checks.held_by[NAMES[k]] for k in right)


def test_a_piece_turned_by_three_degrees_is_held():
    pieces = coupon()
    pieces[4] = turned_by(pieces[4], 3)
    checks, failures = judge_assembly(pieces, planned(pieces))
    assert NAMES[4] in failures["assembly"]
    assert set(checks.held_by[NAMES[4]]) <= {NAMES[1], NAMES[3]}


@pytest.mark.parametrize("wide_below", [False, True])
def test_a_knob_with_an_undercut_along_its_axis_is_held(wide_below):
    knob, hole = dovetail(wide_below)
    first, held = judge_assembly([hole, knob], planned([hole, knob]))
    assert held.get("assembly", []) == (["piece_002"] if wide_below else [])
    assert first.held_by == ({"piece_002": ["piece_001"]} if wide_below else {})
    assert bool(judge_assembly([knob, hole], planned([knob, hole]))[1]) != wide_below


def test_a_piece_under_another_is_held_by_it_unless_it_comes_first():
    pieces = coupon()
    roof = moved(box([0, 0, 0], [TILE, TILE, 1]), [TILE, TILE, 5.0])
    before = [roof, *pieces]
    names = ["roof", *NAMES]
    way = dict.fromkeys(names, UP)
    named = [(name, *piece) for name, piece in zip(names, before, strict=True)]
    checks, failures = judge_assembly(named, AssemblyPlan(names, way))
    assert NAMES[4] in failures["assembly"]
    assert all(held == ["roof"] for held in checks.held_by.values())
    assert judge_assembly(named, AssemblyPlan([*NAMES, "roof"], way))[1] == {}


def test_two_pieces_that_changed_places_in_the_order_are_found():
    stack = [moved(box([0, 0, 0], [TILE, TILE, 1]), [0, 0, 1.5 * k]) for k in range(4)]
    assert judge_assembly(stack, planned(stack))[1] == {}
    swapped = [NAMES[k] for k in (0, 2, 1, 3)]
    checks, failures = judge_assembly(stack, planned(stack, order=swapped))
    assert failures == {"assembly": [NAMES[1]]}
    assert checks.held_by == {NAMES[1]: [NAMES[2]]}


@pytest.mark.parametrize("last", range(4))
def test_no_block_closes_a_ring_and_those_that_hold_it_are_named(last):
    blocks = ring()
    assert overlaps(blocks).total == 0
    order = [NAMES[(last + k) % 4] for k in range(1, 5)]
    out = dict(zip(NAMES, ([0, 1, 0], [-1, 0, 0], [0, -1, 0], [1, 0, 0]), strict=False))  # off the peg before
    before, after = order[2], order[0]
    held_by = set()
    for way in (*np.eye(3), *-np.eye(3), *np.random.default_rng(last).normal(size=(20, 3))):
        checks, failures = judge_assembly(blocks, AssemblyPlan(order, out | {NAMES[last]: way}))
        assert failures == {"assembly": [NAMES[last]]}
        assert checks.held_by.keys() == {NAMES[last]}
        assert {before, after} & {*checks.held_by[NAMES[last]]}
        held_by |= {*checks.held_by[NAMES[last]]}
    assert {before, after} <= held_by


def test_what_is_held_by_less_than_the_material_gives_is_pressed_in():
    lid = box([0.2, 0.2, 0], [9.8, 9.8, 2])
    lip = box([-5, 0, 3], [0.22, 10, 4])  # reaches 0.02 mm over the lid
    assert judge_assembly([lip, lid], planned([lip, lid]))[1] == {"assembly": ["piece_002"]}
    for give, press in ((0.05, 0.02), (0.2, 0.02)):
        checks, failures = judge_assembly([lip, lid], planned([lip, lid], give=give))
        assert failures == {}
        assert (checks.proved, checks.straight) == (2, 1)
        assert press <= checks.press_mm <= give
    assert judge_assembly([lip, lid], planned([lip, lid], give=0.015))[1]


def test_what_is_held_goes_out_after_a_shift_that_is_free_itself():
    lid, lip = box([0.2, 0.2, 0], [9.8, 9.8, 2]), box([-5, 0, 3], [0.23, 10, 4])
    by = {"piece_002": [0.1, 0.0, 0.0]}
    checks, failures = judge_assembly([lip, lid], planned([lip, lid], shift=by))
    assert (failures, checks.straight) == ({}, 2)
    wall = box([9.85, 0, 0], [12, 10, 2])  # 0.05 mm beside the lid
    pieces = [lip, lid, wall]
    order = ["piece_001", "piece_003", "piece_002"]
    checks, failures = judge_assembly(pieces, planned(pieces, shift=by, order=order))
    assert failures == {"assembly": ["piece_002"]}
    assert checks.held_by == {"piece_002": ["piece_003"]}


def test_what_is_in_the_way_of_a_piece_once_it_is_shifted_is_found():
    roof, tile = box([20, 0, 5], [30, 10, 6]), box([0, 0, 0], [10, 10, 2])
    assert judge_assembly([roof, tile], planned([roof, tile]))[1] == {}
    aside = {"piece_002": [20.0, 0.0, 0.0]}
    failures = judge_assembly([roof, tile], planned([roof, tile], shift=aside))[1]
    assert failures == {"assembly": ["piece_002"]}


@pytest.mark.parametrize("way", [None, [0, 0, 0], [np.nan, 0, 1], [0, 1]])
def test_a_piece_without_a_way_or_a_place_in_the_order_is_not_proved(way):
    pieces = coupon()[:3]
    ways = {NAMES[0]: UP, NAMES[1]: UP} | ({} if way is None else {NAMES[2]: way})
    for order in (NAMES[:3], NAMES[:2]):
        checks, failures = judge_assembly(pieces, AssemblyPlan(order, ways))
        assert failures == {"assembly": [NAMES[2]]}
        assert checks.proved == 2


def test_an_eaten_neighbour_is_found_by_its_volume():
    pieces = coupon()
    laid_out = {name: mesh_volume(*piece) for name, piece in zip(NAMES, pieces, strict=True)}
    checks, failures = judge_assembly(pieces, planned(pieces, laid_out=laid_out))
    assert (failures, checks.volume_error) == ({}, 0)
    for height, wrong in ((0.87, []), (0.83, [NAMES[8]])):
        eaten = Shape(coupon()[8].V * [1, 1, height], coupon()[8].F)
        checks, failures = judge_assembly([*pieces[:8], eaten], planned(pieces, laid_out=laid_out))
        assert checks.volume_error == pytest.approx(1 - height)
        assert failures.get("volume_error", []) == wrong


def folder_of(path, pieces, order=None, ways=None):
    """Write pieces and a report with a plan, as meshjig does."""
    (path / "pieces").mkdir(parents=True)
    for name, piece in zip(NAMES, pieces, strict=False):
        write_stl(path / f"pieces/{name}.stl", *piece)
    ids = list(range(1, len(pieces) + 1))
    motion = {"axis": UP, "shift": [0, 0, 0], "turn": None}
    laid_out = {str(i): mesh_volume(*piece) for i, piece in zip(ids, pieces, strict=True)}
    report = {
        "options": {},
        "pieces": [{"id": i, "neighbours": []} for i in ids],
        "assembly": {
            "order": order or ids,
            "motions": {str(i): motion | {"axis": (ways or {}).get(i, UP)} for i in ids},
            "give_mm": 0.0,
            "laid_out_mm3": laid_out,
        },
    }
    (path / "report.json").write_text(json.dumps(report))
    return path


def test_a_folder_is_proved_by_the_plan_in_its_report(tmp_path):
    told = check_folder([folder_of(tmp_path, coupon())], {})
    assert told["failures"] == {}
    assert told["assembly"]["proved"] == told["assembly"]["straight"] == 9
    assert told["assembly"]["volume_error"] == pytest.approx(0, abs=1e-5)


def test_a_folder_whose_files_or_plan_were_changed_is_found_out(tmp_path):
    stack = [moved(box([0, 0, 0], [TILE, TILE, 2]), [0, 0, 3.0 * k]) for k in range(3)]
    swapped = check_folder([folder_of(tmp_path / "a", stack, order=[1, 3, 2])], {})
    assert swapped["failures"] == {"assembly": [NAMES[1]]}
    aside = check_folder([folder_of(tmp_path / "b", coupon(), ways={5: [1.0, 0.0, 0.0]})], {})
    assert aside["failures"] == {"assembly": [NAMES[4]]}
    eaten = folder_of(tmp_path / "c", stack)
    write_stl(eaten / f"pieces/{NAMES[2]}.stl", *moved(box([0, 0, 0], [TILE, 8, 2]), [0, 0, 6.0]))
    assert check_folder([eaten], {})["failures"] == {"volume_error": [NAMES[2]]}
