"""Knobs keep clear of edges where they run, not where their ends are."""

import numpy as np
import pytest

from meshjig.tiling.knob_clearance import surroundings


@pytest.mark.parametrize(("bulge", "hit"), [(0.0, False), (4.0, True)])
def test_an_edge_bent_towards_a_knob_is_seen(bulge, hit):
    t = np.linspace(0, 1, 41)
    plain = np.stack([20 * t, 0 * t], 1)
    beyond = np.stack([20 * t, 10 - bulge * np.sin(np.pi * t)], 1)
    drawn = np.stack([plain, beyond])
    knob = np.stack([20 * t, 7 * np.exp(-(((t - 0.5) / 0.1) ** 2))], 1)
    around = surroundings(drawn, 0.5, 0.0)
    found = around.hit(knob[None], np.array([0]), drawn, np.zeros(2, bool), slice(12, 29))
    assert found.tolist() == [hit]
