"""A puzzle whose pieces hardly hold each other says so, and what it says helps."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

from meshjig import make_puzzle
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.pipeline.ground import limit_asked
from meshjig.pipeline.notes import lock_note, thin_notes
from meshjig.scan.thin_share import ThinShare
from tests.meshes import sphere

SMALL = {"pieces": 30}


def locks(**options):
    report = make_puzzle(sphere(320, 10.0), assembly="off", **options).report
    return report["checks"]["interlocked_length"], report["notes"]


def test_what_the_note_advises_locks_the_puzzle():
    share, notes = locks(**SMALL)
    assert share < 0.5
    assert len(notes) == 1
    assert "only 0 % of the border length is locked" in notes[0]
    size, pieces = (float(re.search(rf"--{name} (\d+)", notes[0])[1]) for name in ("size", "pieces"))
    assert "--process sla" in notes[0]
    for better in ({"size": size, **SMALL}, {"pieces": int(pieces)}, {"process": "sla", **SMALL}):
        share, notes = locks(**better)
        assert share > 0.5
        assert not notes


def test_pieces_asked_for_by_their_size_are_to_be_larger():
    share, notes = locks(piece_size=6.5)
    assert share < 0.5
    larger = float(re.search(r"--piece-size (\d+\.?\d*)", notes[0])[1])
    assert "--size" not in notes[0]
    assert locks(piece_size=larger)[0] > 0.5


class FewLocks:
    """Borders of which a fifth is locked."""

    def interlocked_length(self, clearance):
        return 0.2


def test_tiles_are_to_be_larger():
    whole = SimpleNamespace(
        cells=None, atlas=SimpleNamespace(mesh=Mesh(*sphere(320, 10.0))), piece_of_face=np.arange(60)
    )
    note = lock_note(whole, FewLocks(), Options.of(tile="classic", pieces=60))
    assert "20 % of the border length" in note
    assert "--size 32" in note
    assert "--pieces 24" in note


THICK = ThinShare(1.2, 0.0, 150.0, None, None)


def test_where_the_model_is_thin_the_note_says_how_much_and_what_cures_it():
    thin = ThinShare(1.2, 0.0314, 225.0, 0.8, [1.2, -30.6, 7.0])
    (note,) = thin_notes(thin, Options())
    assert note.startswith("3.1 % of the model is thinner than 1.2 mm, down to 0.8 mm around (1, -31, 7) mm")
    assert "--size 230" in note
    assert not thin_notes(THICK, Options())


def test_walls_asked_for_thinner_than_the_least_wall_are_said():
    (note,) = thin_notes(THICK, Options(thickness=1.0))
    assert "walls of 1 mm were asked for, thinner than the 1.2 mm of --min-wall" in note


@pytest.mark.parametrize(
    ("option", "value", "cure"),
    [
        ("side", "out", "--side in"),
        ("clearance", 0.0, "a larger one"),
        ("clearance_method", "domain", "solid cuts it through"),
    ],
)
def test_what_keeps_thin_parts_from_being_cut_through_is_said(option, value, cure):
    V, F = sphere(1000)
    flat = V * [1.0, 0.8, 0.08], F
    asked = {"pieces": 6, "size": 60, "thickness": 0.8, "process": "sla", "layout": "tiles", option: value}
    report = make_puzzle(flat, **asked, assembly="off").report
    assert report["through"]["limit_mm"] == 0
    (note,) = [note for note in report["notes"] if "cut through" in note]
    assert "of the model is thinner than 1." in note
    assert cure in note


def test_nothing_is_said_of_thin_parts_that_were_not_to_be_cut_through():
    assert limit_asked(Options(through="off", side="out")) == 0
    assert not thin_notes(THICK, Options(side="out"), ThinShare(6.0, 0.0, 150.0, None, None))
