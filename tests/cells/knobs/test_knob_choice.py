"""The choice of knobs is about the best there is, and never has two that conflict."""

import itertools

import numpy as np

from meshjig.cells.knobs.knob_choice import Choices, choose


def puzzle(rng, n_cells=5, per_border=4):
    """Borders between all neighbours in a ring, the last choice of each free of conflicts but dear."""
    n = n_cells * per_border
    border = np.repeat(np.arange(n_cells), per_border)
    side = rng.random(n) < 0.5
    a, b = border, (border + 1) % n_cells
    cost = rng.random(n)
    area = rng.uniform(0.1, 0.2, n)
    plain = np.arange(per_border - 1, n, per_border)
    cost[plain], area[plain] = 8.0, 0.0
    i, j = np.triu_indices(n, 1)
    adjacent = np.isin((border[j] - border[i]) % n_cells, [1, n_cells - 1])
    adjacent &= ~np.isin(i, plain) & ~np.isin(j, plain)
    conflict = np.stack([i, j], 1)[adjacent & (rng.random(len(i)) < 0.3)]
    return Choices(border, cost, np.where(side, a, b), np.where(side, b, a), area), conflict


def energy(choices, conflicts, picked, n_cells):
    taken = np.isin(np.arange(len(choices.border)), picked)
    if taken[conflicts].all(1).any():
        return np.inf
    excess = np.zeros(n_cells)
    np.add.at(excess, choices.gives[picked], -choices.area[picked])
    np.add.at(excess, choices.takes[picked], choices.area[picked])
    return choices.cost[picked].sum() + 40 * (excess**2).sum()


def test_choice_is_mostly_the_best_of_all():
    found, best = [], []
    for seed in range(10):
        rng = np.random.default_rng(seed)
        choices, conflicts = puzzle(rng)
        everything = itertools.product(*np.arange(20).reshape(5, 4))
        best.append(min(energy(choices, conflicts, np.array(picked), 5) for picked in everything))
        picked = choose(choices, conflicts, np.ones(5), 5, rng)
        assert choices.border[picked].tolist() == list(range(5))
        found.append(energy(choices, conflicts, picked, 5))
    assert np.isfinite(found).all()  # no conflict
    assert (np.array(found) < np.array(best) + 0.1).sum() >= 7


def test_knobs_enter_the_cells_that_are_too_large():
    both = np.repeat(np.arange(3), 2)
    gives, takes = np.array([0, 1, 1, 2, 2, 3]), np.array([1, 0, 2, 1, 3, 2])
    choices = Choices(both, np.zeros(6), gives, takes, np.full(6, 0.1))
    picked = choose(
        choices, np.zeros((0, 2), int), np.array([1.2, 1.0, 1.0, 0.8]), 3, np.random.default_rng(0)
    )
    assert picked.tolist() == [0, 2, 4]
