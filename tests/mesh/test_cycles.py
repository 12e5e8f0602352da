"""Cycles of a permutation, and chains, against a plain walk."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshjig.mesh.cycles import chains, cycles


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
