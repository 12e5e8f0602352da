"""After a run a person is told what to do next, and which pieces to look at."""

from pathlib import Path

import pytest

from meshjig.cli.terminal import tell_next_step, tell_notes

MADE = {"viewer": True, "guide": True, "format": ["stl", "3mf"], "pieces": 6, "piece_size": None}


@pytest.mark.parametrize(
    ("options", "plates", "words"),
    [
        ({}, [], ["meshjig view out/a-jigsaw shows it", "print puzzle.3mf", "guide.pdf"]),
        ({}, [{"plate": 1}], ["print the files in plates/"]),
        ({"format": ["stl"], "viewer": False}, [], ["preview.png shows it", "print what is in pieces/"]),
        ({"format": ["glb"]}, [], ["print puzzle.glb"]),
    ],
)
def test_the_next_step_is_said(capsys, options, plates, words):
    tell_next_step({"options": MADE | options, "plates": plates}, Path("out/a-jigsaw"))
    said = capsys.readouterr().err
    assert said.startswith("next: ")
    assert all(word in said for word in words), said


def test_thin_necks_are_named(capsys):
    names = [f"piece_{k:03d}" for k in range(1, 7)]
    report = {
        "options": MADE | {"min_wall": 1.2, "min_neck": 2.0},
        "pieces": [{}] * 6,
        "input": {"notes": []},
        "checks": {"thin_necks": 7},
        "names": {"thin_necks": names},
    }
    tell_notes(report)
    said = capsys.readouterr().err.splitlines()
    assert any(
        "7 knobs" in line and "2 mm: piece_001, piece_002" in line and "2 more" in line for line in said
    )
