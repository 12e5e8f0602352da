"""The option pole from the command line, and from the library, to the finished pieces."""

import json
import subprocess
import sys

import numpy as np
import pytest
import trimesh

import meshjig
from tests.charts.revolved import vase

ASKED = {"size": 110, "pieces": 24, "charts": "periodic", "assembly": "off"}


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    path = tmp_path_factory.mktemp("meshes") / "vase.ply"
    trimesh.Trimesh(*vase(), process=False).export(path)
    return path


def run(*words):
    words = [sys.executable, "-m", "meshjig", "make", *map(str, words)]
    return subprocess.run(words, capture_output=True, encoding="utf-8", check=False)


def at_the_pole(meshes):
    """List the pieces that come to the middle of the foot."""
    return [mesh for mesh in meshes if np.linalg.norm(mesh.vertices, axis=1).min() < 1.0]


def test_wedges_meet_at_the_foot_of_a_vase(mesh, tmp_path):
    words = [word for name, value in ASKED.items() for word in (f"--{name}", value)]
    said = run(mesh, "-o", tmp_path / "out", *words, "--pole", "wedge", "--format", "stl")
    assert said.returncode == 0, said.stderr
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["options"]["pole"] == "wedge"
    (pole,) = report["stitching"]["poles"]
    assert pole["closed_by"] == "wedge"
    pieces = [trimesh.load(path) for path in sorted((tmp_path / "out" / "pieces").iterdir())]
    assert all(piece.is_watertight for piece in pieces)
    assert len(at_the_pole(pieces)) == pole["meeting"] > 2


def test_if_not_told_otherwise_a_capstone_does(mesh):
    puzzle = meshjig.make_puzzle(mesh, **ASKED)
    assert puzzle.report["ok"]
    (pole,) = puzzle.report["stitching"]["poles"]
    assert pole["closed_by"] == "capstone"
    pieces = [piece.mesh for piece in puzzle.pieces]
    (stone,) = (piece for piece in pieces if np.hypot(*piece.center_mass[[0, 2]]) < 1.0)
    assert stone.vertices[:, 1].min() < 0.1
    assert all(piece is stone for piece in at_the_pole(pieces))


def test_another_way_is_refused(mesh, tmp_path):
    said = run(mesh, "-o", tmp_path / "out", "--pole", "dome")
    assert said.returncode == 2
    assert "pole" in said.stderr
    assert "wedge, capstone" in said.stderr
