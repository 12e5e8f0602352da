"""Plans of caps: pieces near the size of a tile, few that meet, no capstone too wide."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshjig.tiling.poles.plan import plan_pole

RADII = st.floats(0.1, 8.0)


@given(radius=RADII, depth=st.floats(0.0, 1.5), around=st.integers(0, 60))
def test_levels_go_inward_and_at_most_eight_meet(radius, depth, around):
    plan = plan_pole("wedge", radius, depth, around)
    if plan is None:
        assert around < 2
        return
    assert plan.levels[0] == 1
    assert (np.diff(plan.levels) < 0).all()
    assert min(plan.levels) > 0
    assert (plan.meeting or (0 if plan.capstone else around)) <= 8
    assert len(plan.levels) == len(plan.counts) + 1 + (plan.capstone and len(plan.levels) > 1)


@given(radius=RADII, depth=st.floats(0.0, 1.5), around=st.integers(0, 60))
def test_a_capstone_is_never_wider_than_a_tile_and_a_half(radius, depth, around):
    for style in ("wedge", "capstone"):
        plan = plan_pole(style, radius, depth, around)
        if plan is not None and plan.capstone:
            assert 2 * radius * plan.levels[-1] <= 1.5 + 1e-9


@pytest.mark.parametrize("depth", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("radius", [2.0, 3.1, 4.7, 6.2])
def test_rows_hold_tiles_near_to_whole_ones(radius, depth):
    around = round(2 * np.pi * radius)
    plan = plan_pole("wedge", radius, depth, around)
    edges = radius * np.array([*plan.levels[1:], 0.0])
    area = np.pi * (edges[:-1] ** 2 - edges[1:] ** 2) / np.array(plan.counts)
    assert area.min() > 0.6
    assert area.max() < 1.6


def test_a_wedge_too_small_for_a_piece_takes_the_capstones_place():
    plan = plan_pole("capstone", 0.2, 0.5, 3)
    assert not plan.capstone
    assert plan.why
