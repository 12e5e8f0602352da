"""Pieces of different bodies that are nearer than the clearance are named with the place."""

from types import SimpleNamespace

import numpy as np
import pytest

from meshjig.mesh.pieces import Pieces
from meshjig.options import Options
from meshjig.pipeline.bodies import note_contacts
from tests.check.pieces import box
from tests.meshes import Shape, joined, moved, sphere

BALL = sphere(1280, 10.0)


def noted(first, second):
    """What is said of two pieces, each a body of its own."""
    whole = joined(first, second)
    layout = SimpleNamespace(
        cut=SimpleNamespace(F=whole.F), piece_of_face=np.repeat([0, 1], [len(first.F), len(second.F)])
    )
    return note_contacts(Pieces.of([("a", *first), ("b", *second)]), layout, Options.of(clearance=0.2))


@pytest.mark.parametrize(("apart", "said"), [(0.02, 1), (0.18, 1), (0.2, 0), (5.0, 0)])
def test_balls_nearer_than_the_clearance_are_named(apart, said):
    notes = noted(BALL, moved(BALL, [20 + apart, 0, 0]))
    assert len(notes) == said
    assert all("nearer than 0.2 mm" in note and "a and b around (10, 0, 0) mm" in note for note in notes)


@pytest.mark.parametrize("overlap", [0.0, 1.0])
def test_boxes_that_touch_or_cross_are_named_with_the_place(overlap):
    large, small = Shape(*box([0, 0, 0], [30, 30, 10])), Shape(*box([10, 10, 10 - overlap], [14, 14, 14]))
    notes = noted(large, small)
    assert len(notes) == 1
    assert "a and b around (12, 12, 10) mm" in notes[0]
