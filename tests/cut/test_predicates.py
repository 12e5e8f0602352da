"""Exact predicates, judged by rational numbers."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshjig.cut.predicates import angular_order, orient, point_left_of_edge, vertex_left_of_segment

SMALL = st.integers(0, 3)
LARGE = st.integers(0, 2**30 - 1)
EPS = Fraction(1, 2**200)


def point(coordinate):
    return st.tuples(coordinate, coordinate)


def exact_turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def shifted(p):
    return p[0] + EPS, p[1] + EPS**2


def arrays(*points):
    return (np.array([p], np.int64) for p in points)


@given(point(LARGE), point(LARGE), point(LARGE))
def test_orient_is_exact_up_to_the_limit(a, b, c):
    assert orient(*arrays(a, b, c))[0] == exact_turn(a, b, c)


@given(point(SMALL), point(SMALL), point(SMALL))
def test_a_point_is_left_of_an_edge_as_a_tiny_shift_says(p, q, c):
    P, Q, C = arrays(p, q, c)
    left = point_left_of_edge(orient(P, Q, C), P, Q)[0]
    assert left == (p == q or exact_turn(p, q, shifted(c)) > 0)


@given(point(SMALL), point(SMALL), point(SMALL))
def test_a_vertex_is_left_of_a_segment_as_a_tiny_shift_says(a, b, v):
    if a == b:
        return
    A, B, C = arrays(a, b, v)
    left = vertex_left_of_segment(orient(A, B, C), A, B)[0]
    assert left == (exact_turn(shifted(a), shifted(b), v) > 0)


@given(st.lists(st.tuples(st.integers(0, 4), st.integers(-9, 9), st.integers(-9, 9)), max_size=60))
def test_directions_are_sorted_by_angle_about_each_node(rows):
    rows = [r for r in dict.fromkeys(rows) if r[1:] != (0, 0)]
    node = np.array([r[0] for r in rows], np.int64)
    d = np.array([r[1:] for r in rows], np.int64).reshape(-1, 2)
    order = angular_order(node, d)
    assert sorted(order.tolist()) == list(range(len(rows)))
    assert (np.diff(node[order]) >= 0).all()
    angle = np.arctan2(d[:, 1], d[:, 0]) % (2 * np.pi)
    for n in set(node.tolist()):
        around = angle[order][node[order] == n]
        if len(around) > 2:
            assert (np.diff(around) >= -1e-12).all()
