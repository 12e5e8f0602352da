from itertools import pairwise

import numpy as np
import pytest
import shapely

from meshjig.solid.simplify_chain import simplified


def wavy(n=400, seed=0):
    t = np.linspace(0, 6, n)
    rng = np.random.default_rng(seed)
    X = np.stack([5 * t, np.sin(3 * t), 0.1 * rng.normal(size=n).cumsum()], 1)
    return X, X + np.stack([0.3 * np.sin(2 * t), 0.2 * np.cos(t), np.full(n, -2.0)], 1)


def farthest(P, kept):
    """The largest distance of a point to the line of the kept ones, in each coordinate plane."""
    gaps = []
    for axes in ([0, 1], [1, 2], [0, 2]):
        for i, j in pairwise(kept):
            line = shapely.LineString(P[[i, j]][:, axes])
            gaps.append(shapely.distance(line, shapely.points(P[i : j + 1][:, axes])).max())
    return max(gaps)


@pytest.mark.parametrize("tolerance", [0.01, 0.1, 0.5])
def test_both_lines_stay_within_the_tolerance(tolerance):
    X, Y = wavy()
    kept = np.flatnonzero(simplified(X, Y, np.array([0, len(X)]), tolerance, 9.0))
    assert kept[0] == 0
    assert kept[-1] == len(X) - 1
    assert farthest(X, kept) <= tolerance * (1 + 1e-9)
    assert farthest(Y, kept) <= tolerance * (1 + 1e-9)


def test_a_larger_tolerance_keeps_fewer_points():
    X, Y = wavy()
    counts = [simplified(X, Y, np.array([0, len(X)]), t, 9.0).sum() for t in (0.001, 0.01, 0.1, 1.0)]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > 2 * counts[-1]


def test_straight_lines_keep_their_ends_only_and_lines_dont_mix():
    t = np.linspace(0, 1, 20)[:, None]
    lines = [t * [10.0, 0, 0], [0, 5.0, 0] + t * [0, 10.0, 3], [9.0, 9, 9] + t * [1.0, 1, 1]]
    X = np.concatenate(lines)
    kept = simplified(X, X - [0, 0, 2.0], np.array([0, 20, 40, 60]), 1e-6, 1e-6)
    assert np.flatnonzero(kept).tolist() == [0, 19, 20, 39, 40, 59]


def test_the_inner_line_counts_as_much_as_the_outer_one():
    t = np.linspace(0, 1, 21)[:, None]
    X = t * [10.0, 0, 0]
    Y = X - [0, 0, 2.0] + np.where(np.arange(21)[:, None] == 7, [0, 0.5, 0], 0)
    kept = np.flatnonzero(simplified(X, Y, np.array([0, 21]), 0.05, 9.0))
    assert 7 in kept
    assert len(kept) == 5  # the bump, its feet, and the ends


def test_a_ring_keeps_three_corners_at_least():
    a = np.linspace(0, 2 * np.pi, 41)
    X = np.stack([np.cos(a), np.sin(a), 0 * a], 1)
    X[-1] = X[0]
    assert simplified(X, X - [0, 0, 1.0], np.array([0, 41]), 0.3, 9.0).sum() >= 4


def test_a_twisted_wall_is_split_until_its_diagonals_lie_on_it():
    t = np.linspace(0, 1, 65)
    X = np.stack([4 * t, 0 * t, 0 * t], 1)
    Y = X + np.stack([0 * t, 0.8 * t, np.full(65, -2.0)], 1)  # two straight lines; the wall leans over
    flat = simplified(X, Y, np.array([0, 65]), 0.02, 9.0)
    split = np.flatnonzero(simplified(X, Y, np.array([0, 65]), 0.02, 0.05))
    assert flat.sum() == 2
    middle = (X[split[:-1]] + Y[split[1:]]) / 2  # of diagonals
    ruled = 0.8 * (middle[:, 0] / 4) / 2  # y halfway down the ruled wall
    assert np.abs(middle[:, 1] - ruled).max() <= 0.05 + 1e-9


def test_a_wall_that_turns_in_its_own_plane_is_split_too():
    t = np.linspace(0, 1, 65)
    X = np.stack([4 * t, 0 * t, 0 * t], 1)
    Y = X + np.stack([2 * t, 0 * t, np.full(65, -2.0)], 1)
    kept = np.flatnonzero(simplified(X, Y, np.array([0, 65]), 0.02, 0.05))
    down = (Y - X)[kept] / np.linalg.norm((Y - X)[kept], axis=1)[:, None]
    assert len(kept) > 2
    assert (np.einsum("ij,ij->i", down[:-1], down[1:]) > np.cos(np.radians(25))).all()
