"""Ragged lists count as lists do, and links connect as they should."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshjig.mesh.arrays import connected, equal_pairs, next_in_loop, ragged, ranks, row_of, starts

SIZES = st.lists(st.integers(0, 5), max_size=8).map(lambda sizes: np.array(sizes, np.int64))


@given(SIZES, st.integers(0, 100))
def test_ragged_lists_are_those_of_python(sizes, shift):
    first = 10 * np.arange(len(sizes)) + shift
    counted = [(row, rank) for row, n in enumerate(sizes.tolist()) for rank in range(n)]
    assert ranks(sizes).tolist() == [rank for _, rank in counted]
    assert row_of(sizes).tolist() == [row for row, _ in counted]
    assert ragged(first, sizes).tolist() == [10 * row + shift + rank for row, rank in counted]
    assert starts(sizes).tolist() == [sum(sizes.tolist()[:k]) for k in range(len(sizes))]


@pytest.mark.parametrize(
    ("n", "links", "labels"),
    [
        (4, [], [0, 1, 2, 3]),
        (4, [(2, 3)], [0, 1, 2, 2]),
        (5, [(4, 0), (1, 2), (2, 1), (3, 3)], [0, 1, 1, 2, 0]),
        (3, [(0, 2)] * 300, [0, 1, 0]),  # a link is one however often it comes
    ],
)
def test_links_connect_directly_and_through_others(n, links, labels):
    a, b = np.array(links, np.int64).reshape(-1, 2).T
    count, label = connected(n, a, b)
    assert count == max(labels) + 1
    assert label.tolist() == labels


@given(SIZES)
def test_closed_lists_come_back_to_their_start(sizes):
    after = next_in_loop(sizes)
    row, rank = row_of(sizes), ranks(sizes)
    assert (row[after] == row).all()
    assert (rank[after] == (rank + 1) % sizes[row]).all()


@given(st.lists(st.integers(0, 5), max_size=9), st.lists(st.integers(0, 5), max_size=9))
def test_equal_pairs_are_all_there_are(a, b):
    i, j = equal_pairs(np.array(a, np.int64), np.array(b, np.int64))
    every = [(p, q) for p in range(len(a)) for q in range(len(b)) if a[p] == b[q]]
    assert list(zip(i.tolist(), j.tolist(), strict=True)) == every
