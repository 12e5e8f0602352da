"""A note says where no file keeps what the scan shows."""

import numpy as np
import pytest

from meshjig.output.lost_colours import lost_colours
from meshjig.output.piece import Piece
from meshjig.output.save import Outputs, save_puzzle
from meshjig.output.scan_picture import Picture
from meshjig.output.texture import Texture
from tests.meshes import sphere

V, F = sphere(100)
COLOURS = Texture(np.ones(len(F), bool), np.zeros((len(F), 3, 3)))
PICTURE = Texture(
    COLOURS.outer, COLOURS.rgb, np.zeros((len(F), 3, 2)), Picture(np.zeros((4, 4, 3), np.uint8))
)


def piece(texture):
    return [Piece("piece_001", V, F, (0, 0, 0), texture=texture)]


@pytest.mark.parametrize(
    ("texture", "formats", "plates", "words"),
    [
        (None, ["stl"], False, None),
        (COLOURS, ["stl"], False, "the colours of the scan"),
        (PICTURE, ["stl"], False, "the texture of the scan"),
        (PICTURE, ["stl"], True, None),
        (PICTURE, ["stl", "3mf"], False, None),
        (PICTURE, ["obj"], False, None),
        (PICTURE, ["stl", "ply"], False, "at vertices only"),
        (COLOURS, ["ply"], False, None),
    ],
)
def test_only_what_is_lost_is_named(texture, formats, plates, words):
    notes = lost_colours(piece(texture), formats, plates)
    assert [words in note for note in notes] == ([] if words is None else [True])


def test_the_note_is_in_the_report_once(tmp_path):
    report = {"timings_s": {}, "input": {"notes": ["another"]}, "pieces": {}}
    outputs = Outputs(["stl"], preview=False, viewer=False, guide=False)
    for name in ("a", "b"):
        report = save_puzzle(tmp_path / name, piece(COLOURS), report, outputs)
    assert len(report["input"]["notes"]) == 2
