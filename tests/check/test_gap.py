import numpy as np
import pytest

from meshjig.check import gaps, judge
from meshjig.check.thickness import without_sheets
from tests.check.pieces import box, hemisphere_shells, turned

LEFT = box([0, 0, 0], [10, 10, 2], 6)


def right(gap, n=5):
    return box([10 + gap, 0, 0], [20, 10, 2], n)


@pytest.mark.parametrize("gap", [0.1, 0.2, 0.5])
@pytest.mark.parametrize("seed", range(2))
def test_plates_apart_have_that_gap_everywhere(gap, seed):
    measured = gaps([turned(piece, seed) for piece in (LEFT, right(gap))], clearance=gap)
    assert measured.facts(gap) == pytest.approx(
        {"min": gap, "p1": gap, "median": gap, "within_10pct": 1.0}, abs=1e-6
    )


def test_the_rims_of_half_spheres_have_their_gap():
    facts = gaps(hemisphere_shells(20, 2, 0.2), clearance=0.2).facts(0.2)
    assert facts == pytest.approx({"min": 0.2, "p1": 0.2, "median": 0.2, "within_10pct": 1.0}, abs=1e-6)


def test_a_tapering_gap_is_measured_along_its_length():
    V, F = right(0.2)
    V = V + np.outer((V[:, 0] < 11) * 0.1 * (V[:, 1] - 5) / 5, [1, 0, 0])  # from 0.1 to 0.3
    measured = gaps([LEFT, (V, F)], clearance=0.2)
    assert measured.min == pytest.approx(0.1, abs=1e-3)
    facts = measured.facts(0.2)
    assert facts["median"] == pytest.approx(0.2, abs=0.01)
    assert facts["within_10pct"] == pytest.approx(0.2, abs=0.03)


def test_a_gap_too_wide_is_seen_only_where_neighbours_are_named():
    pieces = [LEFT, right(0.8)]
    assert gaps(pieces, clearance=0.2).facts(0.2) == {
        "min": None,
        "p1": None,
        "median": None,
        "within_10pct": None,
    }
    named = gaps(pieces, neighbours=np.array([[0, 1]]), clearance=0.2).facts(0.2)
    assert named["median"] == pytest.approx(0.8)
    assert named["within_10pct"] == 0


def test_only_named_neighbours_are_measured():
    close = box([0, 0, 2.05], [10, 10, 4])  # lies on the first, but shares no border with it
    measured = gaps([LEFT, right(0.2), close], neighbours=np.array([[0, 1]]), clearance=0.2)
    assert [pair[:2] for pair in measured.pairs] == [(0, 1)]
    assert measured.facts(0.2)["p1"] == pytest.approx(0.2)


@pytest.mark.parametrize("gap", [0.0, -0.05])
def test_pieces_that_touch_or_overlap_have_no_gap(gap):
    measured = gaps([LEFT, right(gap)], clearance=0.2)
    assert measured.min == 0
    assert measured.facts(0.2)["median"] == pytest.approx(0, abs=1e-9)
    assert measured.facts(0.2)["within_10pct"] == 0


def test_a_piece_inside_another_has_no_gap():
    assert gaps([LEFT, box([4, 4, 0.5], [6, 6, 1.5])]).min == 0


def test_unknown_clearance_leaves_the_share_unknown():
    facts = gaps([LEFT, right(0.3)]).facts(None)
    assert facts["median"] == pytest.approx(0.3)
    assert facts["within_10pct"] is None


def test_an_open_piece_leaves_its_least_distance_unknown():
    measured = gaps([LEFT, (right(0.2)[0], right(0.2)[1][:-1])], clearance=0.2)
    assert measured.pairs == [(0, 1, None)]
    assert measured.min is None


def test_a_lone_piece_has_no_gaps():
    assert gaps([LEFT]).facts(0.2) == {"min": None, "p1": None, "median": None, "within_10pct": None}


def test_sheets_that_face_each_other_in_a_fold_are_no_walls():
    lower, upper = box([0, 0, 0], [20, 10, 2], 10), box([16, 0, 2.5], [40, 10, 4.5], 10)
    measured = gaps([lower, upper], neighbours=np.array([[0, 1]]), clearance=0.2)
    assert measured.min == pytest.approx(0.5)
    assert len(measured.samples) == 0


def test_samples_know_their_pieces():
    row = [box([10.2 * k, 0, 0], [10.2 * k + 10, 10, 2]) for k in range(3)]
    measured = gaps(row, neighbours=np.array([[0, 1], [1, 2]]), clearance=0.2)
    pairs, count = np.unique(measured.sample_pair, axis=0, return_counts=True)
    assert pairs.tolist() == [[0, 1], [1, 2]]
    assert (count > 100).all()
    assert measured.wide(0.25) == []
    assert measured.wide(0.15) == [(0, 1), (1, 2)]


def fin(gap):
    """Two plates, 2 mm thick, one upon the other: within 0.2 mm along a border, farther apart elsewhere."""
    front, back = box([0, 0, 0], [30, 30, 2], 30), box([0, 0, 2], [30, 30, 4], 30)
    for half, way in ((front, -1), (back, 1)):
        inner = (half.V[:, 2] == 2) & (half.V[:, 0] > 1.5)
        half.V[half.V[:, 2] == 2, 2] += 0.1 * way
        half.V[inner, 2] += way * gap / 2
    return front, back


def test_sheets_that_face_each_other_inside_a_fin_are_no_wide_gap():
    halves = fin(0.4)
    measured = gaps(halves, neighbours=np.array([[0, 1]]), clearance=0.2)
    assert measured.wide(0.25) == [(0, 1)]
    assert without_sheets(measured, halves, [(0, 1)], np.full(2, 2.5)).wide(0.25) == []
    verdict = judge(halves, neighbours=[(0, 1)], clearance=0.2, thickness=2.0)
    assert "gap_wide_mm" not in verdict.failures


def test_walls_too_far_apart_are_no_sheets():
    row = [box([10.4 * k, 0, 0], [10.4 * k + 10, 10, 2], 10) for k in range(2)]
    measured = gaps(row, neighbours=np.array([[0, 1]]), clearance=0.2)
    assert without_sheets(measured, row, [(0, 1)], np.full(2, 2.5)).wide(0.25) == [(0, 1)]
    assert len(without_sheets(measured, row, [(0, 1)], np.full(2, 2.5)).samples) == len(measured.samples)
