import numpy as np
import pytest

from meshjig.check import judge
from meshjig.errors import InputError
from tests.check.pieces import box, folded_plate, hemisphere_shells
from tests.meshes import inside_out, joined, moved

GOOD = hemisphere_shells(20, 2, 0.2)
ASKED = {"thickness": 2.0, "clearance": 0.2}
CHECKS = {
    "closed",
    "one_component",
    "self_intersections",
    "overlap_mm3",
    "gap_mm",
    "thickness_mm",
    "thin_walls",
    "area_error",
    "discarded_volume_share",
    "interlocked_borders",
    "interlocked_length",
    "head_neck",
    "thin_necks",
    "area_cv",
}


def without_a_face(piece):
    return piece[0], piece[1][1:]


def with_a_speck(piece):
    return joined(piece, box([50, 0, 0], [51, 1, 1]))


def pushed(piece, z):
    return moved(piece, [0, 0, z])


def test_a_sound_puzzle_keeps_every_promise():
    verdict = judge(GOOD, neighbours=[(0, 1)], **ASKED)
    assert verdict.failures == {}
    assert verdict.ok
    assert set(verdict.checks) == CHECKS
    assert verdict.checks["closed"]
    assert verdict.checks["self_intersections"] == 0
    assert verdict.checks["overlap_mm3"] == pytest.approx(0, abs=1e-9)
    assert verdict.checks["gap_mm"]["within_10pct"] == 1
    assert verdict.checks["area_cv"] is None


@pytest.mark.parametrize(
    ("second", "promise", "blamed"),
    [
        (without_a_face(GOOD[1]), "closed", ["b"]),
        (with_a_speck(GOOD[1]), "one_component", ["b"]),
        (inside_out(GOOD[1]), "positive_volume", ["b"]),
        (pushed(folded_plate(), 100), "self_intersections", ["b"]),
        (pushed(GOOD[1], 0.3), "overlap_mm3", ["a", "b"]),
        (pushed(GOOD[1], 0.02), "gap_mm", ["a", "b"]),
        (pushed(box([0, 0, 0], [90, 90, 3]), 100), "thickness_mm", ["b"]),
    ],
)
def test_each_promise_can_be_broken_and_names_the_piece(second, promise, blamed):
    pieces = [("a", *GOOD[0]), ("b", *second)]
    verdict = judge(pieces, **ASKED)
    assert not verdict.ok
    assert verdict.failures[promise] == blamed


def test_what_an_exempt_piece_breaks_is_named_but_not_held_against_the_puzzle():
    pieces = [("a", *GOOD[0]), ("b", *pushed(GOOD[1], 0.3)), ("c", *pushed(folded_plate(), 100))]
    assert set(judge(pieces, **ASKED).failures) == {"overlap_mm3", "gap_mm", "self_intersections"}
    others = [(f"d{k}", *box([120 * k, 300, 0], [120 * k + 100, 400, 2], 1)) for k in range(18)]
    verdict = judge([*pieces, *others], **ASKED, exempt_pieces=["b", "c"])
    assert verdict.ok
    assert verdict.exempt == {"self_intersections": ["c"], "overlap_mm3": ["b"], "gap_mm": ["b"]}
    assert verdict.checks["self_intersections"] > 0


@pytest.mark.parametrize(("n", "excused"), [(18, True), (17, False)])
def test_so_many_exempt_pieces_are_no_puzzle(n, excused):
    broken = [("b", *pushed(GOOD[1], 0.3)), ("c", *pushed(folded_plate(), 100))]
    others = [(f"d{k}", *box([120 * k, 300, 0], [120 * k + 100, 400, 2], 1)) for k in range(n - 1)]
    verdict = judge([("a", *GOOD[0]), *broken, *others], **ASKED, exempt_pieces=["b", "c", "d1"])
    assert verdict.failures == ({} if excused else {"exempt": ["b", "c"]})


def test_so_much_exempt_area_is_no_puzzle():
    small = [box([3 * k, 0, 0], [3 * k + 2, 2, 2]) for k in range(40)]
    large = [box([0, 10, 0], [30, 40, 2]), box([29, 10, 0], [60, 40, 2])]
    verdict = judge([*small, *large], exempt_pieces=["piece_041", "piece_042"])
    assert verdict.failures == {"exempt": ["piece_041", "piece_042"]}


def test_an_exempt_piece_does_not_excuse_the_others():
    row = [box([10 * k, 0, 0], [10 * k + 9.9, 10, 2]) for k in range(4)]
    verdict = judge(row, **ASKED, exempt_pieces=["piece_001"])
    assert verdict.failures == {
        "gap_mm": ["piece_002", "piece_003", "piece_004"],
        "exempt": ["piece_001"],
    }
    assert verdict.exempt == {"gap_mm": ["piece_001"]}


def test_an_exempt_piece_must_still_be_closed():
    verdict = judge([("a", *without_a_face(GOOD[0]))], exempt_pieces=["a"])
    assert verdict.failures["closed"] == ["a"]
    assert not verdict.ok


@pytest.mark.parametrize(
    ("gap", "wide"), [(0.205, False), (0.218, False), (0.23, True), (0.9, True), (5.0, True)]
)
def test_a_gap_too_wide_is_seen_between_named_neighbours(gap, wide):
    row = [box([(10 + gap) * k, 0, 0], [(10 + gap) * k + 10, 10, 2]) for k in range(3)]
    verdict = judge(row, neighbours=[(0, 1), (1, 2)], clearance=0.2)
    assert verdict.failures == ({"gap_wide_mm": ["piece_001", "piece_002", "piece_003"]} if wide else {})


def test_one_wide_gap_among_many_is_named():
    row = [box([10.2 * k + (k > 2) * 0.07, 0, 0], [10.2 * k + 10 + (k > 2) * 0.07, 10, 2]) for k in range(6)]
    verdict = judge(row, neighbours=[(k, k + 1) for k in range(5)], clearance=0.2)
    assert verdict.failures == {"gap_wide_mm": ["piece_003", "piece_004"]}


def test_walls_too_thin_for_the_process_are_named_and_break_a_promise():
    pieces = [("thick", *box([0, 0, 0], [9, 9, 2])), ("thin", *box([10, 0, 0], [19, 9, 1]))]
    verdict = judge(pieces, min_wall=1.2)
    assert verdict.checks["thin_walls"] == 1
    assert verdict.named == verdict.failures == {"thin_walls": ["thin"]}
    assert judge(pieces).checks["thin_walls"] is None


def test_a_piece_that_breaks_a_promise_twice_is_named_once_and_in_order():
    row = [box([10 * k, 0, 0], [10 * k + 9.9, 10, 2]) for k in (2, 1, 0)]
    assert judge(row, **ASKED).failures["gap_mm"] == ["piece_001", "piece_002", "piece_003"]


def test_a_promise_about_an_unknown_figure_is_not_held():
    verdict = judge([GOOD[0], pushed(GOOD[1], 0.1)])
    assert verdict.ok
    assert verdict.checks["gap_mm"]["median"] == pytest.approx(0.1, abs=1e-6)
    assert verdict.checks["gap_mm"]["within_10pct"] is None
    assert verdict.checks["thickness_mm"]["thin_area_share"] is None


def test_overlap_of_an_open_piece_is_unknown():
    verdict = judge([GOOD[0], without_a_face(GOOD[1])])
    assert verdict.checks["overlap_mm3"] is None
    assert verdict.failures["overlap_mm3"] == ["piece_002"]


@pytest.mark.parametrize(
    ("pieces", "neighbours", "what"),
    [
        ([], None, "no pieces"),
        ([("leg", np.full((3, 3), np.inf), np.array([[0, 1, 2]]))], None, "leg: .*finite"),
        (GOOD, [(0, 2)], "beyond the 2"),
    ],
)
def test_what_cannot_be_judged_is_refused(pieces, neighbours, what):
    with pytest.raises(InputError, match=what):
        judge(pieces, neighbours=neighbours)
