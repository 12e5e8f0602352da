"""Pieces that stand too near to a neighbour are found by the verdict, and mended."""

import numpy as np
import pytest

from meshjig.judged import judged
from meshjig.options import Options
from tests.meshes import sphere

NAMES = ("one", "other")
PAIR = np.array([[0, 1]])


@pytest.fixture(scope="module")
def balls():
    """Two balls that are 0.12 mm apart where they are nearest."""
    V, F = sphere(2000)
    V = 5 * V / np.linalg.norm(V, axis=1, keepdims=True)
    aside = np.array([np.ptp(V[:, 0]) + 0.12, 0, 0])
    return [(V, F), (V + aside, F)]


def test_balls_nearer_than_the_gap_are_dented_until_the_verdict_is_content(balls):
    solids, verdict, facts = judged(balls, NAMES, PAIR, Options(clearance=0.2), [])
    assert facts["dented"] == [0, 1]
    assert facts["discarded"] == 0  # nothing has come off
    assert verdict.checks["gap_mm"]["min"] >= 0.97 * 0.2
    assert not verdict.near
    assert [len(V) for V, _ in solids] != [len(V) for V, _ in balls]


def test_pieces_that_keep_the_gap_are_left_as_they_are(balls):
    solids, verdict, facts = judged(balls, NAMES, PAIR, Options(clearance=0.1), [])
    assert solids is balls
    assert facts == {"dented": [], "discarded": 0.0}
    assert "gap_mm" not in verdict.failures


def test_gaps_of_the_plane_are_judged_but_not_mended(balls):
    solids, verdict, _ = judged(balls, NAMES, PAIR, Options(clearance=0.2, clearance_method="stretch"), [])
    assert solids is balls
    assert verdict.failures["gap_mm"] == list(NAMES)
