from itertools import pairwise

import numpy as np
import pytest

from meshjig.solid.border_chains import border_chains
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
