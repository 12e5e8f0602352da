"""Stitching on region graphs small enough to know the answer."""

import numpy as np
import pytest

from meshjig.layout.stitch import stitch, sum_borders
from meshjig.mesh.types import RegionGraph


def graph(area, borders):
    """Borders: (region, region, length, is seam)."""
    pairs = np.array([b[:2] for b in borders], np.int64).reshape(-1, 2)
    return RegionGraph(
        np.array(area, float),
        pairs,
        np.array([b[2] for b in borders], float),
        np.array([b[3] for b in borders], bool),
    )


def groups(stitching):
    return [np.flatnonzero(stitching.piece_of_region == p).tolist() for p in range(stitching.n_pieces)]


@pytest.mark.parametrize(("share", "pieces"), [(0.3, [[0, 1], [2]]), (0.95, [[0], [1], [2]])])
def test_halves_join_over_a_seam_when_they_share_enough_of_it(share, pieces):
    # region 0 has 10 mm of seam: 9 with region 1, 1 with region 2, which has 100 mm elsewhere
    borders = [(0, 1, 9, True), (0, 2, 1, True), (1, 2, 30, True)]
    assert groups(stitch(graph([50, 50, 100], borders), share, 100)) == pieces


def test_a_share_of_either_side_is_enough():
    borders = [(0, 1, 3, True), (1, 2, 27, True)]
    assert groups(stitch(graph([40, 60, 90], borders), 0.3, 100)) == [[0, 1], [2]]


def test_cuts_are_not_stitched():
    assert stitch(graph([50, 50], [(0, 1, 10, False)]), 0.3, 100).n_pieces == 2


def test_joins_along_a_seam_do_not_run_away():
    area = np.full(20, 60.0)
    borders = [(i, i + 1, 5, True) for i in range(19)]
    stitching = stitch(graph(area, borders), 0.3, 100)
    assert np.bincount(stitching.piece_of_region, area).max() <= 140
    assert stitching.n_pieces == 10


def test_smallest_joins_come_first():
    borders = [(0, 1, 10, True), (1, 2, 10, True)]
    assert groups(stitch(graph([100, 30, 40], borders), 0.3, 100)) == [[0], [1, 2]]


def test_tiny_pieces_join_the_neighbour_with_most_border():
    borders = [(0, 1, 4, False), (0, 2, 6, False), (1, 2, 10, False)]
    stitching = stitch(graph([10, 100, 100], borders), 0.3, 100)
    assert groups(stitching) == [[0, 2], [1]]
    assert stitching.facts.tiny_merged == 1


def test_borders_of_merged_pieces_add_up():
    # 0 and 1 are tiny and join; together they touch 3 more than 2
    borders = [(0, 1, 5, False), (0, 2, 4, False), (0, 3, 3, False), (1, 3, 3, False), (2, 3, 9, False)]
    assert groups(stitch(graph([4, 5, 100, 100], borders), 0.3, 100)) == [[0, 1, 3], [2]]


def test_a_tiny_island_stays():
    stitching = stitch(graph([1, 100, 100], [(1, 2, 10, False)]), 0.3, 100)
    assert stitching.n_pieces == 3
    assert stitching.facts.tiny_left == 1


def test_stretches_of_border_add_up_by_pair_and_kind():
    here, there = np.array([0, 1, 1, 0]), np.array([1, 0, 2, 1])
    summed = sum_borders(
        np.ones(3), here, there, np.array([1.0, 2, 4, 8]), np.array([True, True, False, False])
    )
    found = {
        (a, b, bool(s)): x
        for (a, b), s, x in zip(summed.pairs.tolist(), summed.seam, summed.length, strict=True)
    }
    assert found == {(0, 1, True): 3.0, (0, 1, False): 8.0, (1, 2, False): 4.0}


def test_a_join_too_short_to_hold_is_not_made():
    borders = [(0, 1, 1.0, True), (1, 2, 20, False)]
    assert stitch(graph([60, 60, 60], borders), 0.3, 100).n_pieces == 2
    assert stitch(graph([60, 60, 60], borders), 0.3, 100, least_border=2.0).n_pieces == 3


def test_what_stays_alone_joins_over_no_seam_nor_takes_tiny_pieces():
    borders = [(0, 1, 20, True), (1, 2, 9, False), (0, 2, 1, False), (1, 3, 9, False), (0, 3, 11, False)]
    lonely = graph([50, 50, 100, 2], borders)
    assert groups(stitch(lonely, 0.3, 100)) == [[0, 1, 3], [2]]
    assert groups(stitch(lonely, 0.3, 100, alone=np.array([0]))) == [[0], [1, 3], [2]]
