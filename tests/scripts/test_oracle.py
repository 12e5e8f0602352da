import copy
import json
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "scripts/oracle.py"

MADE = {
    "input": "0a",
    "pieces": {
        "piece_001": {
            "V": [[4, 3], "float64", "1a"],
            "F": [[4, 3], "int64", "2a"],
            "box": [0.0] * 3 + [9.0] * 3,
        }
    },
    "core": {},
    "report": {"ok": True, "failures": {}, "checks": {"gap_mm": {"min": 0.2}}, "pieces": [{"id": 1}]},
}
FAILED = {"input": "0a", "failure": "CutError: it can't be cut"}


def compare(tmp_path, old, new, *flags):
    for name, puzzle in (("old", old), ("new", new)):
        record = {"commit": name, "puzzles": {"vase.ply tiles": puzzle, "duck.ply core": FAILED}}
        (tmp_path / name).write_text(json.dumps(record))
    command = [sys.executable, SCRIPT, "compare", tmp_path / "old", tmp_path / "new", *flags]
    return subprocess.run(command, capture_output=True, encoding="utf-8", check=False)


def changed(**values):
    """Give the puzzle with other values, named by their path."""
    made = copy.deepcopy(MADE)
    for path, value in values.items():
        *above, last = path.split("__")
        inner = made
        for key in above:
            inner = inner[key]
        inner[last] = value
    return made


def test_equal_puzzles_and_equal_failures_pass(tmp_path):
    done = compare(tmp_path, MADE, MADE)
    assert done.returncode == 0
    assert "2 equal" in done.stdout


@pytest.mark.parametrize(
    ("new", "says"),
    [
        (changed(pieces={}), "pieces: 1 -> 0"),
        (changed(report__checks__gap_mm__min=0.1), "report checks.gap_mm.min: 1 differ, relative difference"),
        (
            changed(report__failures={"gap_mm": ["piece_001"]}),
            "report failures.gap_mm.*: 1 differ, nothing -> ",
        ),
        (changed(report__pieces=[{"id": True}]), "report pieces.*.id: 1 differ, 1 -> True"),
        (changed(input="0b"), "the mesh itself"),
        (FAILED, "failure: a puzzle -> CutError: it can't be cut"),
    ],
)
def test_a_puzzle_that_differs_is_told_and_fails(tmp_path, new, says):
    done = compare(tmp_path, MADE, new)
    assert done.returncode == 1
    assert says in done.stdout


def test_other_bits_are_close_where_the_checks_agree(tmp_path):
    moved = changed(pieces__piece_001__V=[[4, 3], "float64", "1b"], report__checks__gap_mm__min=0.2 + 1e-9)
    done = compare(tmp_path, MADE, moved)
    assert done.returncode == 1
    assert "vase.ply tiles: close" in done.stdout
    assert "of 1 only coordinates; boxes by at most 0.0e+00 mm: piece_001" in done.stdout
    assert compare(tmp_path, MADE, moved, "--close").returncode == 0


def test_names_choose_what_is_compared(tmp_path):
    assert compare(tmp_path, MADE, FAILED, "--only", "duck").returncode == 0
    assert compare(tmp_path, MADE, FAILED, "--sets", "core").returncode == 0
    assert compare(tmp_path, MADE, FAILED, "--only", "nobody").returncode == 1
