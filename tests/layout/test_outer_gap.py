"""The gap on the surface, on plates whose gap is known."""

import numpy as np
import pytest

from meshjig.layout.outer_gap import outer_gap


def plates(*gaps, side=10.0):
    """A flat strip: square plates with given gaps between them."""
    widths = [side, *(w for gap in gaps for w in (gap, side))]
    x = np.cumsum([0.0, *widths])
    V = np.vstack([np.c_[x, np.full(len(x), y), np.zeros(len(x))] for y in (0.0, side)])
    a, n = np.arange(len(widths)), len(x)
    F = np.stack([np.stack([a, a + 1, a + n + 1], 1), np.stack([a, a + n + 1, a + n], 1)], 1).reshape(-1, 3)
    return V, F, np.repeat(np.where(a % 2 == 0, a // 2, -1), 2)


def test_parallel_borders_have_their_distance():
    gap = outer_gap(*plates(0.2, 0.2), 0.2)
    assert gap["min"] == pytest.approx(0.2)
    assert gap["median"] == pytest.approx(0.2)
    assert gap["within_10pct"] > 0.95


def test_a_narrow_and_a_wide_gap_are_seen():
    gap = outer_gap(*plates(0.1, 0.2, 0.3), 0.2)
    assert gap["min"] == pytest.approx(0.1)
    assert gap["within_10pct"] == pytest.approx(1 / 3, abs=0.05)


def test_a_piece_alone_has_no_gap():
    assert set(outer_gap(*plates(), 0.2).values()) == {None}


def test_the_open_border_is_no_gap():
    V, F, piece = plates(0.2)
    V = V * [1, 0.05, 1]  # the long sides lie 0.5 mm apart, and open
    assert outer_gap(V, F, piece, 0.2)["within_10pct"] == 1.0
