"""Outlines on the grid keep their shape and their labels."""

import numpy as np
import pytest

from meshjig.cut.snap import snap
from meshjig.errors import CutError
from meshjig.mesh.types import Outlines
from tests.cut.graphs import grid_graph, loops, square

UV = np.array([[0.0, 0.0], [100.0, 100.0]])


def test_nothing_changes_on_the_grid():
    g = grid_graph(np.arange(0, 101, 10.0), np.arange(0, 101, 10.0), 2)
    U, graph = snap(UV, g)
    step = (U[1] - U[0]) / 100
    np.testing.assert_array_equal(graph.points[graph.point] / step, g.points)
    np.testing.assert_array_equal(graph.points[graph.segments], graph.points[graph.point[g.segments]])
    np.testing.assert_array_equal(graph.source, np.arange(len(g.segments)))
    np.testing.assert_array_equal(graph.left, g.left)


@pytest.mark.parametrize("extent", [1.0, 700.0, 5_000.0, 1e6])
def test_coordinates_stay_below_the_limit(extent):
    U, graph = snap(UV - extent / 3, loops(square(extent / 2, 0, extent / 2), labels=[1]))
    assert min(U.min(), graph.points.min()) >= 0
    assert max(U.max(), graph.points.max()) < 2**30


def test_short_segments_vanish_and_the_curve_stays_closed():
    a, b, c, d = square(50, 50, 10)
    tiny = np.array([0, 1e-6])
    knots = np.array([a + tiny, b, c, d, d + tiny, a])
    _, graph = snap(UV, loops(knots, labels=[1]))
    assert len(graph.segments) == 4
    assert (np.bincount(graph.segments.ravel(), minlength=4)[np.unique(graph.segments)] == 2).all()


def test_a_band_without_width_becomes_one_line_between_its_neighbours():
    points = np.array([[20, 20], [80, 20], [80, 20 + 1e-6], [20, 20 + 1e-6], [50, 80], [50, -40]])
    ends = np.array([[0, 1], [2, 3], [1, 2], [3, 0], [1, 4], [4, 0], [0, 5], [5, 1]])
    left = np.array([-1, -1, -1, -1, 1, 1, 2, 2])
    right = np.array([2, 1, 7, 7, 7, 7, 7, 7])
    _, graph = snap(UV, Outlines(points, ends, left, right))
    assert len(graph.segments) == 5
    both = set(graph.point[[0, 1]].tolist())
    line = [k for k in range(5) if set(graph.segments[k].tolist()) == both]
    assert len(line) == 1
    k = line[0]
    runs_right = graph.points[graph.segments[k, 1], 0] > graph.points[graph.segments[k, 0], 0]
    assert (graph.left[k], graph.right[k]) == ((1, 2) if runs_right else (2, 1))


def test_a_closed_curve_without_width_vanishes():
    sliver = np.array([[20.0, 20], [80, 20], [80, 20 + 1e-6], [20, 20 + 1e-6]])
    _, graph = snap(UV, loops(sliver, labels=[1]))
    assert len(graph.segments) == 0


def test_a_line_that_ends_on_another_without_a_shared_point_is_joined_to_it():
    points = np.array([[0.0, 0], [90, 30], [30, 10], [30, 60], [60, 20], [0, 60]])
    ends = np.array([[0, 1], [2, 3], [3, 5], [5, 0]])
    _, graph = snap(UV, Outlines(points, ends, np.array([1, 1, 1, 1]), np.array([0, 2, 0, 0])))
    at = graph.segments[(graph.segments == graph.point[2]).any(axis=1)]
    assert len(at) == 3
    first = graph.source == 0
    np.testing.assert_allclose(np.sort(graph.span[first].ravel()), [0, 1 / 3, 1 / 3, 1], atol=1e-6)


def test_coordinates_that_are_no_numbers_are_refused():
    with pytest.raises(CutError, match="no numbers"):
        snap(np.array([[0.0, np.nan]]), loops(square(0, 0, 1), labels=[1]))
