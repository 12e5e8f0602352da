import numpy as np

from meshjig.mesh.boundary_loops import border_loop, border_loops, closed_loops, follow, summed_along
from tests.meshes import cylinder, disc, sphere


def test_the_border_loop_runs_with_the_chart_on_its_left():
    V, F = disc(600)
    loop = border_loop(F)
    np.testing.assert_allclose(np.linalg.norm(V[loop], axis=1), 50)
    x, y = V[np.append(loop, loop[0]), :2].T
    assert (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() > 0
    assert len(np.unique(loop)) == len(loop)
    assert len(border_loop(sphere(100)[1])) == 0


def test_all_border_loops_are_found_with_their_faces_on_the_left():
    _, F = cylinder(600)
    one, other = border_loops(F)
    assert not set(one) & set(other)
    for loop in (one, other):
        edges = set(zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True))
        assert edges <= set(map(tuple, np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]).tolist()))
    assert border_loops(sphere(100)[1]) == []


def test_loops_that_meet_in_a_vertex_are_followed_to_their_ends():
    start, end = np.array([0, 1, 2, 0, 3, 4]), np.array([1, 2, 0, 3, 4, 0])
    loops = closed_loops(start, end)
    assert sorted(np.concatenate(loops).tolist()) == list(range(6))
    for loop in loops:
        np.testing.assert_array_equal(end[loop], np.roll(start[loop], -1))


def test_a_walk_ends_at_the_end_at_its_beginning_or_at_what_was_met_before():
    after = [1, 2, -1, 4, 3, 0]
    seen = set()
    assert [follow(after, k, seen) for k in (0, 4, 5)] == [[0, 1, 2], [4, 3], [5]]
    assert follow(after, 1, seen) == []


def test_values_are_summed_to_the_end_of_each_chain():
    after, values = np.array([1, 2, 2, 0, 5, 5]), np.array([3.0, 4.0, 0.0, 1.5, 2.0, 0.0])
    total, last = summed_along(after, values)
    assert total.tolist() == [7.0, 4.0, 0.0, 8.5, 2.0, 0.0]
    assert last.tolist() == [2, 2, 2, 2, 5, 5]
