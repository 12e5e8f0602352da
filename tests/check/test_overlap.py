import numpy as np
import pytest

from meshjig.check import overlaps
from tests.check.pieces import box, turned

BLOCK = box([0, 0, 0], [10, 10, 10])


@pytest.mark.parametrize("seed", range(3))
def test_the_space_that_boxes_share_is_measured(seed):
    pieces = [BLOCK, box([9, 8, 7], [20, 20, 20]), box([30, 0, 0], [31, 1, 1])]
    found = overlaps([turned(piece, seed) for piece in pieces])
    assert found.total == pytest.approx(1 * 2 * 3)
    assert [(i, j) for i, j, _ in found.pairs] == [(0, 1)]


def test_a_piece_inside_another_shares_all_of_itself():
    assert overlaps([BLOCK, box([4, 4, 4], [5, 6, 7])]).total == pytest.approx(6)


@pytest.mark.parametrize("gap", [0.0, 0.2])
def test_pieces_side_by_side_share_nothing(gap):
    found = overlaps([BLOCK, box([10 + gap, 0, 0], [20, 10, 10], 3), box([-5, -5, -5], [0, 0, 0], 2)])
    assert found.total == pytest.approx(0, abs=1e-9)


def test_an_open_piece_is_unmeasured_and_not_zero():
    found = overlaps([BLOCK, (BLOCK[0] + 5, BLOCK[1][1:]), (BLOCK[0] + [9, 0, 0], BLOCK[1])])
    assert found.unmeasured == [1]
    assert found.total is None
    assert [(i, j) for i, j, _ in found.pairs] == [(0, 2)]
    assert found.pairs[0][2] == pytest.approx(100)


def test_one_piece_overlaps_nothing():
    assert overlaps([(np.asarray(BLOCK[0]), BLOCK[1])]).total == 0
