"""A model with a fin thinner than the least wall: the maker is told, and `check` allows for it as `make`."""

import json
import re

import numpy as np
import pytest
import trimesh

import meshjig
from meshjig.pipeline.check_folder import check_folder


@pytest.fixture(scope="module")
def puzzle():
    """A ball of 40 mm with a fin 1 mm thick, as 12 pieces."""
    ball = trimesh.creation.icosphere(3, 20.0)
    fin = trimesh.creation.box((24, 24, 1.0)).apply_translation([26, 0, 0])
    whole = trimesh.boolean.union([ball, fin], engine="manifold")
    V, F = trimesh.remesh.subdivide_to_size(whole.vertices, whole.faces, 4.0)
    mesh = trimesh.Trimesh(V, F)
    return meshjig.make_puzzle((np.asarray(mesh.vertices), np.asarray(mesh.faces)), pieces=12, assembly="off")


@pytest.mark.slow
def test_the_folder_is_judged_as_the_puzzle_was(puzzle, tmp_path):
    model_thin = puzzle.report["through"]["model_thin"]
    assert max(model_thin.values()) > 0.5
    folder = puzzle.save(tmp_path / "fin", formats=("stl",), preview=False, viewer=False, guide=False)
    assert check_folder([folder], {})["failures"] == puzzle.report["failures"]
    report = json.loads((folder / "report.json").read_text())
    assert report["through"]["model_thin"].keys() == model_thin.keys()


@pytest.mark.slow
def test_the_note_says_where_and_names_the_size_that_cures_it(puzzle):
    (note,) = (note for note in puzzle.report["notes"] if "thinner than 1.2 mm" in note)
    x, y, _ = (float(n) for n in re.search(r"\((.*)\) mm", note)[1].split(","))
    assert x > 18
    assert abs(y) < 12.5
    assert "down to 1 mm" in note
    extent = max(puzzle.report["input"]["size_mm"])
    assert extent * 1.2 <= float(re.search(r"--size (\d+)", note)[1]) < extent * 1.4
