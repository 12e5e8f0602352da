"""Every way in which a puzzle can be wrong, as files on disk, is found by the command.

The pieces of the sound puzzle are two half spheres, 2 mm thick and 0.2 mm apart. Each control differs from
it in one thing.
"""

import json
import subprocess
import sys

import numpy as np
import pytest

from meshjig.output.files.mesh_files import write_stl
from meshjig.output.files.threemf import write_3mf
from meshjig.output.piece import Piece
from tests.check.pieces import box, folded_plate, hemisphere_shells
from tests.meshes import Shape, joined, moved, open_cup

TOP, BOTTOM = hemisphere_shells(20, 2, 0.2)
FOLDED = moved(folded_plate(), [0, 0, 100])


def lowered(by):
    return moved(BOTTOM, [0, 0, -by])


def opened(piece):
    return Shape(piece.V, np.delete(piece.F, 17, axis=0))


def split(piece):
    return joined(piece, box([50, 0, 0], [53, 3, 3]))


def folder_of(path, pieces):
    """Write a puzzle as meshjig does: pieces and a report that names neighbours and what was asked for."""
    (path / "pieces").mkdir()
    for i, piece in enumerate(pieces):
        write_stl(path / f"pieces/piece_{i + 1:03d}.stl", *piece)
    listed = [{"id": 1, "neighbours": [2]}, {"id": 2, "neighbours": [1]}]
    listed += [{"id": i + 1, "neighbours": []} for i in range(2, len(pieces))]
    report = {"options": {"thickness": 2.0, "clearance": 0.2}, "pieces": listed}
    (path / "report.json").write_text(json.dumps(report))
    return path


def judged(*words):
    command = [sys.executable, "-m", "meshjig", "check", *map(str, words), "--json"]
    said = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    return said.returncode, json.loads(said.stdout)["failures"], said.stderr


def test_the_sound_puzzle_is_found_sound(tmp_path):
    assert judged(folder_of(tmp_path, [TOP, BOTTOM])) == (0, {}, "")


@pytest.mark.parametrize(
    ("pieces", "promise", "blamed"),
    [
        ([TOP, BOTTOM, FOLDED], "self_intersections", [3]),
        ([TOP, lowered(-0.3)], "overlap_mm3", [1, 2]),
        ([TOP, lowered(-0.02)], "gap_mm", [1, 2]),
        ([TOP, lowered(0.03)], "gap_wide_mm", [1, 2]),
        ([TOP, lowered(3)], "gap_wide_mm", [1, 2]),
        ([TOP, opened(BOTTOM)], "closed", [2]),
        ([TOP, BOTTOM, open_cup(300)], "closed", [3]),
        ([TOP, split(BOTTOM)], "one_component", [2]),
    ],
    ids=["folded", "overlap", "gap too small", "gap too wide", "far apart", "hole", "open", "split"],
)
def test_each_control_is_found_and_named(pieces, promise, blamed, tmp_path):
    code, failures, said = judged(folder_of(tmp_path, pieces))
    assert code == 3
    assert failures[promise] == [f"piece_{k:03d}" for k in blamed]
    assert f"broken promise: {promise} (piece_{blamed[0]:03d}" in said


def test_a_folder_of_files_by_any_other_name_is_judged(tmp_path):
    write_stl(tmp_path / "left.stl", *TOP)
    write_stl(tmp_path / "right.stl", *lowered(-0.3))
    code, failures, _ = judged(tmp_path)
    assert (code, failures["overlap_mm3"]) == (3, ["left", "right"])


def test_a_lone_3mf_is_judged(tmp_path):
    grey = (0.5, 0.5, 0.5)
    path = tmp_path / "any.3mf"
    write_3mf(path, [Piece("top", *TOP, grey), Piece("bottom", *lowered(-0.1), grey)])
    code, failures, _ = judged(path, "--clearance", 0.2)
    assert (code, failures) == (3, {"gap_mm": ["top", "bottom"]})
