from itertools import pairwise

import numpy as np
import pytest
import shapely

from meshjig.solid.border_chains import border_chains, simplified
from tests.meshes import cylinder, disc, genus2, sphere, torus

SHAPES = {"sphere": sphere(800), "torus": torus(800), "genus2": genus2(800), "cylinder": cylinder(800)}


def patches(V, F, n, seed=1):
    seeds = np.random.default_rng(seed).uniform(-60, 60, (n, 3))
    return np.linalg.norm(V[F].mean(1)[:, None] - seeds[None], axis=2).argmin(1)


def edges_between(F, label):
    """Every edge with two pieces as (tail, head, left, right), the lower piece left; by dictionary."""
    left = {
        (a, b): p for f, p in zip(F.tolist(), label.tolist(), strict=True) for a, b in pairwise([*f, f[0]])
    }
    return {(a, b, p, left[b, a]) for (a, b), p in left.items() if left.get((b, a), -1) > p}


def edges_of(chains):
    found = []
    for k, (i, j) in enumerate(chains.pair.tolist()):
        v = chains.vertex[chains.start[k] : chains.start[k + 1]].tolist()
        found += [(a, b, i, j) for a, b in pairwise(v)]
    return found


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("n", [1, 2, 30])
def test_every_edge_between_two_pieces_is_walked_once(name, n):
    V, F = SHAPES[name]
    label = patches(V, F, n)
    found = edges_of(border_chains(F, label))
    assert len(found) == len(set(found))
    assert set(found) == edges_between(F, label)


@pytest.mark.parametrize("name", SHAPES)
def test_lines_break_at_junctions_and_nowhere_else(name):
    V, F = SHAPES[name]
    label = patches(V, F, 30)
    chains = border_chains(F, label)
    ends = np.array([(a, b) for a, b, _, _ in edges_between(F, label)])
    degree = np.bincount(ends.ravel(), minlength=len(V))
    for k in range(len(chains.pair)):
        v = chains.vertex[chains.start[k] : chains.start[k + 1]]
        assert (degree[v[1:-1]] == 2).all()
        assert v[0] == v[-1] or (degree[v[[0, -1]]] != 2).all()


def test_an_island_has_one_closed_line():
    V, F = disc(600)
    inside = (np.linalg.norm(V[F].mean(1), axis=1) < 20).astype(int)
    chains = border_chains(F, inside)
    assert len(chains.pair) == 1
    assert chains.vertex[0] == chains.vertex[-1]
    x, y, _ = V[chains.vertex].T  # piece 0, outside, lies left: the island is walked around clockwise
    assert (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() < 0


def test_faces_without_a_piece_make_no_border():
    V, F = disc(600)
    gap = np.where(np.linalg.norm(V[F].mean(1), axis=1) < 20, -1, 0)
    assert len(border_chains(F, gap).pair) == 0


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
