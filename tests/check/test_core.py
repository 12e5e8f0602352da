"""A core that is too near, too large or open is found, and what it breaks is named."""

import numpy as np
import pytest

from meshjig.check import add_failures, judge_core
from tests.check.pieces import hemisphere_shells
from tests.meshes import Shape, moved, sphere

CLEARANCE = 0.2
PIECES = [(f"piece_{i + 1:03d}", *half) for i, half in enumerate(hemisphere_shells(20, 2, CLEARANCE))]


def ball(radius):
    return sphere(4000, radius)


def broken_by(core, **keywords):
    return judge_core([("core_1", *core)], PIECES, clearance=CLEARANCE, **keywords)[1]


def test_a_core_that_keeps_its_gap_is_sound():
    facts, failures = judge_core([("core_1", *ball(17.6))], PIECES, clearance=CLEARANCE)
    assert failures == {}
    assert facts.overlap_mm3 == 0
    assert CLEARANCE < facts.gap_mm < 0.45


@pytest.mark.parametrize(
    ("core", "promise"),
    [
        (ball(17.95), "gap_mm"),
        (ball(18.5), "overlap_mm3"),
        (moved(ball(15), [0, 0, 2.95]), "gap_mm"),
        (Shape(ball(17).V, np.delete(ball(17).F, 5, axis=0)), "closed"),
        (Shape(ball(17).V, ball(17).F[:, ::-1]), "positive_volume"),
    ],
)
def test_what_is_wrong_is_named(core, promise):
    assert "core_1" in broken_by(core)[promise]


def test_only_the_piece_that_is_near_is_named_and_an_exempt_one_is_not():
    top = moved(ball(15), [0, 0, 2.95])
    assert broken_by(top)["gap_mm"] == ["core_1", "piece_001"]
    assert broken_by(top, exempt_pieces=["piece_001"]) == {}


def test_failures_are_added_once():
    failures = {"gap_mm": ["piece_001"]}
    add_failures(failures, {"gap_mm": ["core_1", "piece_001"], "closed": ["core_1"]})
    assert failures == {"gap_mm": ["piece_001", "core_1"], "closed": ["core_1"]}
