"""Cycles of a permutation, against a plain walk."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshjig.cut.cycles import cycles


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
        assert (found.of_half_edge[walk] == number).all()
