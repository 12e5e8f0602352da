"""Cycles of a permutation, and chains, against a plain walk."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshjig.mesh.chains import chains, cycles, edge_chains, follow, runs, summed_along

Y_AND_LOOP = np.array([[0, 1], [1, 2], [2, 3], [2, 4], [6, 7], [5, 6], [5, 7]])


@given(st.permutations(range(40)))
def test_cycles_are_those_of_a_walk(permutation):
    follows = np.array(permutation)
    seen, expected = set(), []
    for h in range(len(follows)):
        walk = []
        while h not in seen:
            seen.add(h)
            walk.append(h)
            h = int(follows[h])
        if walk:
            expected.append(walk)
    found = cycles(follows)
    assert [
        found.members[f : f + n].tolist() for f, n in zip(found.first, found.size, strict=True)
    ] == expected
    for number, walk in enumerate(expected):
        assert (found.of_member[walk] == number).all()


@given(st.permutations(range(30)), st.sets(st.integers(0, 29)))
def test_chains_go_from_heads_to_ends_and_cycles_come_after_them(permutation, ends):
    after = np.array(permutation)
    after[list(ends)] = -1
    order, first = chains(after)
    assert sorted(order.tolist()) == list(range(30))
    runs = [run.tolist() for run in np.split(order, first)[1:]]
    assert all(after[run[:-1]].tolist() == run[1:] for run in runs)
    heads = [run[0] for run in runs if after[run[-1]] < 0]
    loops = [run for run in runs if after[run[-1]] >= 0]
    assert heads == sorted(set(range(30)) - set(after.tolist()))
    assert [run[0] for run in runs] == heads + sorted(min(run) for run in loops)
    assert all(after[run[-1]] == run[0] == min(run) for run in loops)


def test_a_chain_ends_where_another_has_been():
    order, first = chains(np.array([2, 2, 3, -1]))
    assert (order.tolist(), first.tolist()) == ([0, 2, 3, 1], [0, 3])


def test_runs_end_at_breaks_and_whole_loops_come_last():
    following = np.array([1, 2, 3, 0, 5, 4])
    goes_on = np.array([True, False, True, False, True, True])
    assert [run.tolist() for run in runs(following, goes_on)] == [[2, 3], [0, 1], [4, 5]]


def test_chains_end_where_edges_end_or_branch_and_loops_are_one():
    found = {frozenset(map(tuple, Y_AND_LOOP[chain])) for chain in edge_chains(Y_AND_LOOP, np.zeros(0, int))}
    assert found == {
        frozenset({(0, 1), (1, 2)}),
        frozenset({(2, 3)}),
        frozenset({(2, 4)}),
        frozenset({(5, 6), (6, 7), (5, 7)}),
    }


def test_chains_are_stopped_and_run_in_order():
    line = np.array([[3, 4], [0, 1], [2, 3], [1, 2], [4, 5]])
    whole, halves = edge_chains(line, np.array([9])), edge_chains(line, np.array([3]))
    assert [chain.tolist() for chain in whole] in ([[1, 3, 2, 0, 4]], [[4, 0, 2, 3, 1]])
    assert sorted(sorted(chain.tolist()) for chain in halves) == [[0, 4], [1, 2, 3]]


def test_a_walk_ends_at_the_end_at_its_beginning_or_at_what_was_met_before():
    after = [1, 2, -1, 4, 3, 0]
    seen = set()
    assert [follow(after, k, seen) for k in (0, 4, 5)] == [[0, 1, 2], [4, 3], [5]]
    assert follow(after, 1, seen) == []


def test_a_ring_without_an_end_does_not_keep_others_from_theirs():
    """As where two borders of a piece meet in a vertex: what follows there has two before it."""
    total, last = summed_along(np.array([1, 1, 3, 2]), np.array([5, 0, 1, 1]))
    assert (total[0], last[0], last[1]) == (5, 1, 1)
    assert set(last[2:].tolist()) == {2, 3}


def test_values_are_summed_to_the_end_of_each_chain():
    after, values = np.array([1, 2, 2, 0, 5, 5]), np.array([3.0, 4.0, 0.0, 1.5, 2.0, 0.0])
    total, last = summed_along(after, values)
    assert total.tolist() == [7.0, 4.0, 0.0, 8.5, 2.0, 0.0]
    assert last.tolist() == [2, 2, 2, 2, 5, 5]
