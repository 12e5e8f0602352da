"""Orders and ways that are known: of sheets, of a ball, and against all orders there are."""

import itertools

import numpy as np
import pytest

from meshjig.assembly import Plan, peel
from meshjig.assembly.peel import CALM
from meshjig.assembly.tilt import DIRECTIONS
from meshjig.mesh.mesh import Mesh
from tests.assembly.sheets import ball, sheet

UP, ASIDE = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def planned(s, up=UP, bans=(), need=None):
    return peel(Mesh(s.V, s.F), s.piece, s.borders, s.need if need is None else need, up, bans)


def is_connected(some, pairs):
    seen, todo = {some[0]}, [some[0]]
    while todo:
        k = todo.pop()
        more = {q for pair in pairs if k in pair for q in pair if q in some} - seen
        seen |= more
        todo += more
    return seen == set(some)


@pytest.mark.parametrize("knob", [False, True])
def test_every_piece_of_a_sheet_goes_straight_in_along_the_normal(knob):
    plan = planned(sheet(knob=knob))
    assert sorted(plan.rank) == list(range(9))
    assert np.linalg.norm(plan.way, axis=1) == pytest.approx(1)
    assert np.degrees(np.arccos(plan.way[:, 2])).max() < 7  # directions are 5 degrees apart
    assert plan.tilt.max() < 7


@pytest.mark.parametrize("sign", [1, -1])
def test_a_sheet_grows_the_way_that_is_up(sign):
    rank = planned(sheet(), sign * ASIDE).rank.reshape(3, 3)[:, ::sign]
    assert rank[:, 0].max() < rank[:, 1].min()
    assert rank[:, 1].max() < rank[:, 2].min()


def test_what_is_there_is_one_part_at_every_step():
    s = ball()
    plan = planned(s)
    order = np.argsort(plan.rank).tolist()
    assert all(is_connected(order[: k + 1], s.borders.pairs.tolist()) for k in range(len(order)))
    mean = np.array([s.V[s.F[s.piece == k]].mean(axis=(0, 1)) for k in range(len(order))])
    off = np.degrees(np.arccos(np.einsum("ij,ij->i", plan.way, mean) / np.linalg.norm(mean, axis=1)))
    assert off[order[1:]].max() < 85


def test_later_names_the_side_that_is_put_in_later():
    plan = Plan(np.array([2, 0, 1]), np.zeros((3, 3)), np.zeros(3))
    assert plan.later(np.array([[0, 1], [1, 2], [0, 2]])).tolist() == [0, 1, 0]


@pytest.mark.parametrize("seed", range(6))
def test_no_order_of_four_pieces_has_a_smaller_largest_tilt(seed):
    s = ball(4, 1200)
    pairs = s.borders.pairs.tolist()
    assert len(pairs) == 6  # each borders on all others
    need = np.random.default_rng(seed).uniform(25, 80, (2, 6, 1)) + np.zeros(len(DIRECTIONS))

    def most(order):  # the first is put in first
        rank = {k: i for i, k in enumerate(order)}
        later = [int(rank[q] > rank[p]) for p, q in pairs]
        return max(need[side, i, 0] for i, side in enumerate(later))

    plan = planned(s, need=need)
    found = most(np.argsort(plan.rank).tolist())
    least = min(most(order) for order in itertools.permutations(range(4)))
    assert found == pytest.approx(max(least, CALM), abs=0.5)  # ways off a piece's normal cost a little


def test_a_way_that_failed_is_not_taken_while_what_was_met_is_there():
    s = ball()
    before = planned(s)
    k = int(np.flatnonzero(before.rank > 5)[0])
    met = frozenset(
        q for pair in s.borders.pairs.tolist() if k in pair for q in pair if before.rank[q] < before.rank[k]
    )
    after = planned(s, bans=[(k, before.way[k], met)])
    others = [q for q in met if after.rank[q] < after.rank[k]]
    assert not others or after.way[k] @ before.way[k] < np.cos(np.radians(8))


def test_a_sheet_under_another_comes_before_it():
    s = sheet(1, 1)
    V = np.concatenate([s.V, s.V + 5 * UP])
    F = np.concatenate([s.F, s.F + len(s.V)])
    piece = np.repeat([0, 1], len(s.F))
    for first in (0, 1):
        label = piece if first == 0 else 1 - piece
        plan = peel(Mesh(V, F), label, s.borders, np.zeros((2, 0, len(DIRECTIONS))), -UP)
        assert plan.rank[first] == 0 or plan.way[first] @ UP < 0.5
        assert plan.way[1 - first] @ UP > 0.9
