"""A body yields to others by the gap, and only there."""

import numpy as np
import pytest

from meshjig.mesh.booleans import body
from meshjig.mesh.mesh import Mesh
from meshjig.solid.keep_clear import keep_clear
from tests.meshes import moved, sphere

GAP = 0.2


def ball(x):
    return Mesh(*moved(sphere(2000, 10.0), [x, 0.0, 0.0]))


@pytest.mark.parametrize("apart", [20.1, 19.9, 18.0])  # too near, touching, overlapping
def test_the_gap_is_kept_afterwards(apart):
    first, other = ball(0.0), ball(apart)
    kept = keep_clear(first, [other], GAP)
    assert body(*kept).min_gap(body(*other), 1.0) >= 0.97 * GAP
    far = kept.V[:, 0] < 5
    assert np.isin(first.V[first.V[:, 0] < 5], kept.V[far]).all()


def test_what_is_clear_stays_as_it_is():
    first = ball(0.0)
    assert keep_clear(first, [ball(20.5), ball(60.0)], GAP) is first


def test_nothing_is_taken_where_nothing_would_be_left():
    first = ball(0.0)
    assert keep_clear(first, [Mesh(*sphere(2000, 30.0))], GAP) is first
