"""Ways along edges are the shortest."""

import numpy as np

from meshjig.mesh.shortest_paths import distances, edge_graph, shortest_way, symmetric
from tests.charts.revolved import pole


def test_the_shortest_way_up_a_tube_is_straight():
    V, F = pole()
    way = shortest_way(edge_graph(V, F), np.arange(60), np.arange(39 * 60, 40 * 60))
    assert len(way) == 40
    assert np.ptp(way % 60) == 0


def test_distances_end_at_the_limit():
    V, F = pole()
    near = distances(edge_graph(V, F), np.arange(60), 30.0)
    np.testing.assert_array_equal(np.isfinite(near), V[:, 1] <= 30.0)
    np.testing.assert_allclose(near[np.isfinite(near)], V[np.isfinite(near), 1])


def test_no_way_leads_to_another_part():
    graph = symmetric(np.array([[0, 1], [2, 3]]), np.array([1.0, 0.0]), 4)
    assert len(shortest_way(graph, np.array([0]), np.array([3]))) == 0
    np.testing.assert_array_equal(shortest_way(graph, np.array([2]), np.array([3])), [2, 3])
