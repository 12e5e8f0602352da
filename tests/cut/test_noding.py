"""Noded segments meet at shared points only."""

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.cut.noding import noded
from tests.cut.graphs import delaunay

SPOTS = st.lists(st.tuples(st.integers(0, 40), st.integers(0, 40)), min_size=4, max_size=24, unique=True)


def assert_noded(points, segments):
    lines = shapely.linestrings(points[segments].astype(float))
    i, j = shapely.STRtree(lines).query(lines, predicate="crosses")
    assert not len(i)
    used = np.unique(segments)
    i, j = shapely.STRtree(lines).query(shapely.points(points[used].astype(float)), predicate="intersects")
    assert (segments[j] == used[i][:, None]).any(axis=1).all()


@settings(max_examples=200)
@given(SPOTS, st.randoms(use_true_random=False))
def test_any_segments_become_noded_and_stay_where_they_were(spots, random):
    points = np.array(spots, np.int64)
    pairs = [(i, j) for i in range(len(spots)) for j in range(len(spots)) if i != j]
    segments = np.array(random.sample(pairs, min(len(pairs), 12)), np.int64)
    p, s, source, _ = noded(points, segments, 1)
    np.testing.assert_array_equal(p[: len(points)], points)
    assert_noded(p, s)
    for k, (a, b) in enumerate(segments.tolist()):
        chain = s[source == k]
        assert chain[0, 0] == a
        assert chain[-1, 1] == b
        np.testing.assert_array_equal(chain[1:, 0], chain[:-1, 1])
        line = shapely.linestrings(points[[a, b]].astype(float))
        assert (
            shapely.distance(shapely.points(p[chain].reshape(-1, 2).astype(float)), line).max() <= 3
        )  # a line may move from point to point on a crowded lattice


def test_segments_that_meet_at_their_ends_stay_as_they_are():
    points = np.array([[0, 0], [10, 0], [10, 10], [0, 10], [5, 5]])
    segments = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [4, 2]])
    p, s, source, _ = noded(points, segments, 1)
    np.testing.assert_array_equal(p, points)
    np.testing.assert_array_equal(s, segments)
    np.testing.assert_array_equal(source, np.arange(6))


def test_long_lines_next_to_each_other_come_to_rest():
    rng = np.random.default_rng(0)
    points = np.unique(np.column_stack([rng.integers(0, 100_000, 60), rng.integers(0, 12, 60)]), axis=0)
    segments = rng.permutation(len(points))[: len(points) // 2 * 2].reshape(-1, 2)
    p, s, *_ = noded(points, segments, 1)
    assert_noded(p, s)


def test_triangles_that_tile_the_plane_are_not_turned_over():
    rng = np.random.default_rng(0)
    for _ in range(20):
        fine = np.unique(np.column_stack([rng.integers(0, 4000, 80), rng.integers(0, 300, 80)]), axis=0)
        triangles = delaunay(fine.astype(float))
        p, s, source, _ = noded(fine, triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), 32)
        assert_noded(p, s)
        a, b = p[s[:, 0]], p[s[:, 1]]
        doubled = np.bincount(source // 3, a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], len(triangles))
        assert doubled.min() >= 0
        assert (doubled == 0).any()
