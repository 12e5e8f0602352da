"""Ear clipping covers polygons with triangles that face up."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshjig.mesh.ears import clip_ears
from meshjig.mesh.measure import face_areas


def star(n, seed, deep):
    """A star-shaped polygon of n corners."""
    rng = np.random.default_rng(seed)
    t = np.sort(rng.uniform(0, 1, n) * 0.5 + np.arange(n)) / n * 2 * np.pi
    return rng.uniform(1 - deep, 1, n)[:, None] * np.column_stack([np.cos(t), np.sin(t)])


def shoelace(P):
    x, y = P[:, 0], P[:, 1]
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def assert_covers(polygons):
    size = np.array([len(p) for p in polygons])
    P, first = np.concatenate(polygons), np.cumsum(size) - size
    T, owner, failed = clip_ears(P, first, size)
    assert not len(failed)
    area = face_areas(P, T)
    assert area.min() > 0
    expected = [shoelace(p) for p in polygons]
    np.testing.assert_allclose(np.bincount(owner, area, len(size)), expected, rtol=1e-9)
    np.testing.assert_array_equal(np.bincount(owner, minlength=len(size)), size - 2)
    assert (first[owner][:, None] <= T).all()
    assert ((first + size)[owner][:, None] > T).all()


@given(st.lists(st.tuples(st.integers(4, 60), st.integers(0, 2**32 - 1)), min_size=1, max_size=12))
def test_star_shaped_polygons(drawn):
    assert_covers([star(n, seed, 0.6) for n, seed in drawn])


@pytest.mark.parametrize("k", [1, 2, 5, 30])
def test_triangles_with_corners_on_their_sides(k):
    corners = np.array([[0.0, 0], [3, 0], [1, 2]])
    t = np.linspace(0, 1, k + 1, endpoint=False)[:, None]
    sides = [corners[i] + t * (corners[(i + 1) % 3] - corners[i]) for i in range(3)]
    assert_covers([np.concatenate([sides[0], corners[1:]]), np.concatenate(sides)])


def test_a_polygon_that_touches_itself_at_a_corner():
    outer = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    hole = np.array([[0.0, 0], [1, 2], [2, 2], [2, 1]])
    assert_covers([np.concatenate([outer, hole])])


def test_a_comb():
    x = np.arange(21.0)
    teeth = np.column_stack([x, np.where(x % 2, 0.1, 5.0)])[::-1]
    assert_covers([np.concatenate([[[0.0, -1], [20, -1]], teeth])])


def test_polygons_that_cover_nothing_are_named():
    flat = np.array([[0.0, 0], [1, 0], [2, 0], [1, 0]])
    back = star(7, 0, 0.3)[::-1]
    good = star(7, 0, 0.3)
    T, owner, failed = clip_ears(
        np.concatenate([flat, good, back]), np.array([0, 4, 11]), np.array([4, 7, 7])
    )
    np.testing.assert_array_equal(failed, [0, 2])
    assert set(owner) == {1}
    assert len(T) == 5
