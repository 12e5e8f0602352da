"""A ball and a box are made so that they go together, and what is changed about the files is found."""

import json
import subprocess
import sys
from contextlib import contextmanager

import numpy as np
import pytest
import trimesh

from meshjig import make_puzzle
from meshjig.check import AssemblyPlan, judge_assembly
from meshjig.check.straight import met_on_the_way
from meshjig.mesh.mesh import Mesh
from meshjig.output.files.mesh_files import write_stl
from meshjig.output.report import read_expectations
from tests.meshes import creased_box, sphere

N = 20


@pytest.fixture(scope="module")
def ball():
    return make_puzzle(sphere(1280, 20.0), pieces=N)


def solids(puzzle):
    return [(piece.name, piece.V, piece.F) for piece in puzzle.pieces]


def plan_in(report):
    names = [f"piece_{i + 1:03d}" for i in range(len(report["pieces"]))]
    return AssemblyPlan(**read_expectations(report, names).assembly)


def test_all_pieces_of_a_ball_go_straight_in_and_have_their_volume(ball):
    told = ball.report["assembly"]
    assert ball.report["failures"] == {}
    assert (told["pieces"], told["proved"], told["straight"]) == (N, N, N)
    assert told["verified"] is True
    assert told["held_by"] == {}
    assert told["press_mm"] == 0
    assert told["volume_error"] < 0.15
    assert told["joined_pieces"] == told["plain_borders"] == 0


def test_pieces_are_numbered_in_the_order_in_which_they_are_put_in(ball):
    told = ball.report["assembly"]
    assert told["order"] == list(range(1, N + 1))
    assert told["steps"] == [[i] for i in range(1, N + 1)]
    there = []
    for row in ball.report["pieces"]:
        assert not there or set(row["neighbours"]) & set(there)  # the ball grows in one part
        there.append(row["id"])
    assert told["islands"] == 1
    mesh = {i + 1: Mesh(piece.V, piece.F) for i, piece in enumerate(ball.pieces)}
    for row in ball.report["pieces"]:
        motion = told["motions"][str(row["id"])]
        moving = Mesh(mesh[row["id"]].V + motion["shift"], mesh[row["id"]].F)
        for other in row["neighbours"]:
            if other < row["id"]:
                assert not met_on_the_way(moving, mesh[other], np.array(motion["axis"])).points


def test_the_plan_in_the_report_proves_the_pieces(ball):
    checks, failures = judge_assembly(solids(ball), plan_in(ball.report))
    assert (checks.proved, failures) == (N, {})
    backward = plan_in(ball.report)
    checks, failures = judge_assembly(solids(ball), backward._replace(order=backward.order[::-1], give=0))
    assert len(failures["assembly"]) > N / 3


def test_walls_along_normals_hold_pieces_of_the_same_ball(ball):
    off = make_puzzle(sphere(1280, 20.0), pieces=N, assembly="off")
    assert "assembly" not in off.report
    assert off.report["failures"] == {}
    assert len(off.pieces) == N
    names = [piece.name for piece in off.pieces]
    out = {name: V.mean(axis=0).tolist() for name, V, _ in solids(off)}
    _, failures = judge_assembly(solids(off), AssemblyPlan(names, out))
    assert len(failures["assembly"]) > N / 2


def test_a_box_goes_together_with_creases():
    V, F = creased_box(1200)
    told = make_puzzle((V / 2.5, F), pieces=12).report["assembly"]
    assert told["proved"] == told["pieces"]
    assert told["volume_error"] < 0.15


def turned(piece, degrees):
    """Turn a piece of a ball around its middle, in its own plane."""
    middle = piece.V.mean(axis=0)
    R = trimesh.transformations.rotation_matrix(np.radians(degrees), middle, middle)
    return piece.V @ R[:3, :3].T + R[:3, 3]


@pytest.fixture(scope="module")
def folder(ball, tmp_path_factory):
    """Write the ball's pieces and its report, without the pictures of a whole puzzle."""
    path = tmp_path_factory.mktemp("ball")
    (path / "pieces").mkdir()
    for piece in ball.pieces:
        write_stl(path / f"pieces/{piece.name}.stl", piece.V, piece.F)
    (path / "report.json").write_text(json.dumps(ball.report))
    return path


def judged(folder):
    command = [sys.executable, "-m", "meshjig", "check", str(folder), "--json"]
    said = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    return said.returncode, json.loads(said.stdout)["failures"]


@contextmanager
def changed(folder, ball):
    """Lend the report's plan, and write the report with what was changed about it."""
    report = json.loads(json.dumps(ball.report))
    yield report["assembly"]
    (folder / "report.json").write_text(json.dumps(report))


def test_the_command_finds_an_order_that_was_changed(ball, folder):
    with changed(folder, ball) as told:
        told["order"][0], told["order"][-1] = N, 1
    code, failures = judged(folder)
    assert code == 3
    assert failures.keys() == {"assembly"}
    assert "piece_001" in failures["assembly"]  # it is amid all the others then


def test_the_command_finds_motions_volumes_and_pieces_that_were_changed(ball, folder):
    last = ball.pieces[-1]
    with changed(folder, ball) as told:
        told["motions"]["10"]["axis"] = [-x for x in told["motions"]["10"]["axis"]]
        told["laid_out_mm3"]["7"] *= 1.2
        write_stl(folder / f"pieces/{last.name}.stl", turned(last, 3), last.F)
    code, failures = judged(folder)
    assert code == 3
    assert failures["assembly"] == ["piece_010", last.name]
    assert failures["volume_error"] == ["piece_007"]
