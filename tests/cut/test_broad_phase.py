"""The grid finds all pairs of boxes that share a cell, once."""

import numpy as np
import pytest

from meshjig.cut.broad_phase import Boxes, box_pairs, boxes, make_cells, near


def random_boxes(n, extent, most, seed):
    rng = np.random.default_rng(seed)
    low = rng.integers(0, extent, (n, 2))
    return Boxes(low, low + rng.integers(0, most, (n, 2)))


@pytest.mark.parametrize(("extent", "most"), [(50, 4), (50, 40), (3, 1), (4000, 1500)])
def test_pairs_are_those_of_a_full_comparison(extent, most):
    A, B = random_boxes(70, extent, most, 0), random_boxes(60, extent, most, 1)
    a, b = box_pairs(A, B)
    found = set(zip(a.tolist(), b.tolist(), strict=True))
    assert len(found) == len(a)
    share = (A.low[:, None] <= B.high[None]).all(axis=2) & (B.low[None] <= A.high[:, None]).all(axis=2)
    needed = set(zip(*(k.tolist() for k in np.nonzero(share)), strict=True))
    assert needed <= found
    if extent < 100:
        assert needed == found


def test_near_boxes_are_those_on_a_cell_with_a_segment():
    rng = np.random.default_rng(0)
    U = rng.integers(0, 10_000, (300, 2))
    S = np.stack([np.arange(299), np.arange(1, 300)], 1)
    a = rng.integers(0, 3000, (40, 2))
    b = a + rng.integers(0, 300, (40, 2))
    cells, around = make_cells(U, S, a, b)
    items = boxes(cells.size, U, U + 200)
    items = Boxes(items.low, np.minimum(items.high, np.array(cells.shape) - 1))
    share = (items.low[:, None] <= around.high[None]).all(axis=2) & (
        around.low[None] <= items.high[:, None]
    ).all(axis=2)
    np.testing.assert_array_equal(near(cells, items), share.any(axis=1))
    assert 0 < share.any(axis=1).sum() < 300
