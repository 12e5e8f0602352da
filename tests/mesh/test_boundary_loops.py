import numpy as np

from meshjig.mesh.boundary_loops import (
    border_loop,
    border_loops,
    borders_by_length,
    closed_loops,
    loops_by_length,
    single_loop,
)
from tests.meshes import cylinder, disc, sphere


def test_the_border_loop_runs_with_the_chart_on_its_left():
    V, F = disc(600)
    loop = border_loop(F)
    np.testing.assert_allclose(np.linalg.norm(V[loop], axis=1), 50)
    x, y = V[np.append(loop, loop[0]), :2].T
    assert (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() > 0
    assert len(np.unique(loop)) == len(loop)
    assert len(border_loop(sphere(100)[1])) == 0


def test_every_border_is_listed_once_and_the_longest_first():
    V, F = cylinder(400)
    F = F[np.abs(V[F].mean(1)[:, 2] - V[:, 2].mean()) < 0.3 * np.ptp(V[:, 2])]
    found = borders_by_length(F)
    assert [len(loop) for loop in found] == sorted(map(len, found), reverse=True)
    assert len(found) == 2
    for loop in found:
        assert len(set(loop.tolist())) == len(loop)
        assert np.ptp(V[loop, 2]) < 0.1 * np.ptp(V[:, 2])


def test_loops_and_single_loops():
    start, end = np.array([3, 0, 1, 2, 8, 9]), np.array([0, 1, 2, 3, 9, 8])
    assert [set(loop.tolist()) for loop in loops_by_length(start, end)] == [{0, 1, 2, 3}, {8, 9}]
    assert single_loop(start, end) is None
    loop = single_loop(start[:4], end[:4])
    assert loop.tolist() == [3, 0, 1, 2]
    assert single_loop(np.array([0, 1, 0, 2]), np.array([1, 0, 2, 0])) is None  # pinched


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
