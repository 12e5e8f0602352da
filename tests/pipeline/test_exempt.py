"""What helps a model that crosses itself is advised, and nothing that doesn't."""

import numpy as np
import pytest

from meshjig.options import Options
from meshjig.pipeline.exempt import exempt_note
from meshjig.pipeline.prepare import clean_scan
from tests.meshes import Shape, half_sphere, joined, moved, sphere

BALLS = joined(sphere(1500), moved(sphere(1500), [70, 0, 0]))
BOWLS = joined(half_sphere(800), moved(half_sphere(800), [40, 0, 5]))
EXEMPT = {"overlap_mm3": ["a", "b"], "gap_mm": ["b", "c"]}


@pytest.mark.parametrize(
    ("mesh", "resurface", "advice"),
    [
        (BALLS, False, "--resurface rebuilds its surface"),
        (BALLS, True, "larger --faces"),
        (BOWLS, False, "too open for --resurface"),
    ],
)
def test_resurfacing_is_advised_only_where_it_works(mesh, resurface, advice):
    options = Options.of(resurface=resurface, faces=3000)
    (note,) = exempt_note(clean_scan(mesh, options), options, EXEMPT)
    assert note.startswith("the mesh crosses itself, and so do 3 pieces: ")
    assert advice in note


def test_nothing_is_said_where_no_piece_needs_it():
    options = Options.of()
    assert exempt_note(clean_scan(sphere(500), options), options, {}) == []


def test_an_open_base_is_left_open_and_not_called_a_hole():
    tall = sphere(2000)
    tall = Shape(tall.V * np.array([0.2, 0.2, 1.0]), tall.F)
    options = Options.of(drop_below=4.0, open_base=True, up="z", fill_holes=50.0)
    scan = clean_scan(tall, options)
    assert scan.facts.filled_holes.left == 1
    assert not any("hole" in note for note in scan.facts.notes)
    closed = clean_scan(tall, Options.of(drop_below=4.0, up="z"))
    assert closed.facts.filled_holes.left == 0
    assert any("a plane closes the cut" in note for note in closed.facts.notes)
