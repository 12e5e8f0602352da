"""What lies above pieces is seen, and nothing else."""

import numpy as np

from meshjig.assembly.sight import Sight
from tests.assembly.sheets import ball, grid, sheet

UP, ASIDE = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def roofed():
    """A sheet 10 mm wide, and 5 mm above it two more that meet along x = 4."""
    V, F = grid(10, 10)
    W, G = grid(10, 10, z=5.0)
    right = W[G].mean(axis=1)[:, 0] > 4
    return (
        np.concatenate([V, W]),
        np.concatenate([F, G + len(V)]),
        np.append(np.zeros(len(F), int), 1 + right),
    )


def test_a_sheet_sees_those_above_it_that_are_still_there():
    sight = Sight(*roofed(), 3)
    there = np.ones(3, bool)
    assert sight.blockers(0, UP, there) == {1, 2}
    assert sight.blockers(0, UP, np.array([True, False, True])) == {2}
    assert sight.blockers(0, UP, np.array([True, False, False])) == set()
    assert sight.blockers(1, UP, there) == sight.blockers(2, UP, there) == set()
    assert sight.blockers(0, ASIDE, there) == sight.blockers(0, -UP, there) == set()


def test_it_sees_through_what_is_gone():
    V, F, piece = roofed()
    W, G = grid(10, 10, z=8.0)
    V, F, piece = (
        np.concatenate([V, W]),
        np.concatenate([F, G + len(V)]),
        np.append(piece, np.full(len(G), 3)),
    )
    sight = Sight(V, F, piece, 4)
    assert sight.blockers(0, UP, np.array([True, False, False, True])) == {3}
    assert sight.blockers(0, UP, np.ones(4, bool)) == {1, 2, 3}


def test_what_ends_shortly_beside_the_way_may_lean_over_it_and_counts():
    V, F, piece = roofed()
    near = V[:, 2] < 1
    V = V * np.where(near[:, None], [0.35, 1, 1], 1)  # it ends half a millimetre before the second roof
    assert Sight(V, F, piece, 3).blockers(0, UP, np.ones(3, bool)) == {1, 2}
    V = V * np.where(near[:, None], [0.5, 1, 1], 1)
    assert Sight(V, F, piece, 3).blockers(0, UP, np.ones(3, bool)) == {1}


def test_neighbours_in_a_sheet_and_on_a_ball_don_t_block_the_way_along_the_normal():
    s = sheet()
    sight = Sight(s.V, s.F, s.piece, 9)
    assert all(not sight.blockers(k, UP, np.ones(9, bool)) for k in range(9))
    s = ball()
    n = s.borders.n_pieces
    sight = Sight(s.V, s.F, s.piece, n)
    for k in range(n):
        out = s.V[s.F[s.piece == k]].mean(axis=(0, 1))
        out /= np.linalg.norm(out)
        assert not sight.blockers(k, out, np.ones(n, bool))
        assert sight.blockers(k, -out, np.ones(n, bool)) - {k}
