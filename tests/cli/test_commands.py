"""The command line as a user meets it: files, exit codes, one sentence."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

from tests.check.pieces import box
from tests.meshes import closed_cylinder, inside_out, joined, moebius, moved, sphere, torus


def run(*words, cwd=None):
    return subprocess.run(
        [sys.executable, "-m", "meshjig", *map(str, words)],
        capture_output=True,
        encoding="utf-8",
        cwd=cwd,
        check=False,
    )


def saved(path, shape):
    trimesh.Trimesh(shape.V, shape.F, process=False).export(path)
    return path


@pytest.fixture(scope="module")
def ball(tmp_path_factory):
    return saved(tmp_path_factory.mktemp("meshes") / "ball.ply", sphere(3000))


@pytest.fixture(scope="module")
def puzzle(ball, tmp_path_factory):
    """A puzzle of a sphere, in every format, and what the command said."""
    folder = tmp_path_factory.mktemp("out") / "ball-jigsaw"
    said = run(
        "make", ball, "-o", folder, "--pieces", 20, "--format", "stl,3mf,obj,glb", "--curves", "--json"
    )
    return folder, said


def test_make_writes_what_it_says(puzzle):
    folder, said = puzzle
    assert said.returncode in (0, 3), said.stderr
    report = json.loads(said.stdout)
    n = len(report["pieces"])
    assert n == pytest.approx(20, abs=2)
    assert report == json.loads((folder / "report.json").read_text())
    assert [p.name for p in sorted((folder / "pieces").iterdir())] == [
        f"piece_{i + 1:03d}.stl" for i in range(n)
    ]
    for name in ("puzzle.3mf", "puzzle.obj", "puzzle.mtl", "puzzle.glb", "preview.png", "curves/cuts.svg"):
        assert (folder / name).stat().st_size > 500, name
    assert f"{n} pieces" in said.stderr


def test_exit_code_tells_whether_promises_are_kept(puzzle):
    folder, said = puzzle
    report = json.loads((folder / "report.json").read_text())
    assert said.returncode == (0 if report["ok"] else 3)
    assert report["ok"] == (not report["failures"])
    assert all(promise in said.stderr for promise in report["failures"])


def test_pieces_cover_the_ball(puzzle):
    folder, _ = puzzle
    report = json.loads((folder / "report.json").read_text())
    meshes = [trimesh.load(p) for p in sorted((folder / "pieces").iterdir())]
    assert all(m.is_watertight and m.volume > 0 for m in meshes)
    shell = 4 / 3 * np.pi * (50**3 - 48**3)
    assert sum(m.volume for m in meshes) == pytest.approx(shell, rel=0.04)
    assert sum(p["area_mm2"] for p in report["pieces"]) == pytest.approx(4 * np.pi * 50**2, rel=0.01)


def test_neighbours_are_mutual(puzzle):
    folder, _ = puzzle
    pieces = json.loads((folder / "report.json").read_text())["pieces"]
    neighbours = {p["id"]: set(p["neighbours"]) for p in pieces}
    assert all(a in neighbours[b] for a, others in neighbours.items() for b in others)
    assert all(neighbours.values())


def test_check_judges_the_files_alone(puzzle, tmp_path):
    folder, _ = puzzle
    for source in (folder, folder / "puzzle.3mf"):
        said = run("check", source, "--json")
        verdict = json.loads(said.stdout)
        assert said.returncode == (0 if verdict["ok"] else 3), said.stderr
        assert verdict["checks"]["closed"] is True
        assert verdict["checks"]["area_error"] is None
        asked = verdict["checks"]["gap_mm"]["within_10pct"] is not None
        assert asked == (source == folder)  # a report.json says what was asked for
    broken = trimesh.load(folder / "pieces/piece_001.stl")
    broken.update_faces(np.arange(len(broken.faces)) != 7)
    broken.export(tmp_path / "broken.stl")
    said = run("check", tmp_path / "broken.stl")
    assert said.returncode == 3
    assert "closed" in said.stderr


def test_info_prints_facts_of_the_mesh(tmp_path):
    said = run("info", saved(tmp_path / "ring.stl", torus(600)), "--json")
    facts = json.loads(said.stdout)
    assert said.returncode == 0
    assert (facts["components"], facts["borders"], facts["genus"], facts["self_crossings"]) == (1, 0, 1, 0)


def test_info_says_how_much_of_a_model_is_thin(tmp_path):
    plate = saved(tmp_path / "plate.stl", box([0, 0, 0], [60, 40, 2]))
    thin = json.loads(run("info", plate, "--json").stdout)["thin"]
    assert thin["through"]["thinner_than_mm"] == pytest.approx(2.6)
    assert thin["through"]["area_share"] > 0.9
    assert thin["through"]["none_from_size_mm"] == pytest.approx(60 * 2.6 / 2, rel=1e-3)
    assert thin["min_wall"]["area_share"] == 0
    thin = json.loads(run("info", plate, "--json", "--thickness", 0.5, "--min-wall", 3).stdout)["thin"]
    assert thin["through"]["thinner_than_mm"] == pytest.approx(6.2)  # two least walls and a gap
    assert thin["min_wall"]["none_from_size_mm"] == pytest.approx(60 * 3 / 2, rel=1e-3)


def test_equal_input_gives_equal_files(ball, tmp_path):
    for name in ("a", "b"):
        run("make", ball, "-o", tmp_path / name, "--pieces", 12, "--seed", 4, "-q")
    files = [sorted((tmp_path / name / "pieces").iterdir()) for name in ("a", "b")]
    assert [p.read_bytes() for p in files[0]] == [p.read_bytes() for p in files[1]]


def test_flags_win_over_the_config_and_the_config_over_presets(ball, tmp_path):
    (tmp_path / "shop.toml").write_text('pieces = 10\nthickness = 3.0\nclearance-method = "domain"\n')
    said = run(
        "make", ball, "-o", tmp_path / "out", "--config", tmp_path / "shop.toml", "--pieces", 8, "--json"
    )
    options = json.loads(said.stdout)["options"]
    assert (options["pieces"], options["thickness"], options["clearance_method"]) == (8, 3.0, "domain")


def test_default_folder_stands_where_the_command_ran(ball, tmp_path):
    assert run("make", ball, "--pieces", 8, "--assembly", "off", cwd=tmp_path).returncode in (0, 3)
    assert (tmp_path / "ball-jigsaw/report.json").is_file()


def test_inside_out_input_is_turned_and_reported(tmp_path):
    mesh = saved(tmp_path / "turned.ply", inside_out(sphere(1000)))
    report = json.loads(run("make", mesh, "-o", tmp_path / "out", "--pieces", 8, "--json").stdout)
    assert report["input"]["repairs"]["turned_inside_out"] == 1
    assert all(p["volume_mm3"] > 0 for p in report["pieces"])


def test_pieces_of_a_model_that_crosses_itself_are_exempt_and_resurfacing_makes_it_whole(tmp_path):
    mesh = saved(tmp_path / "pair.ply", joined(sphere(2000), moved(sphere(2000), [70, 0, 0])))
    for flags in ([], ["--resurface"]):
        asked = ("--pieces", 16, "--faces", 8000, "--assembly", "off", "--json")
        said = run("make", mesh, "-o", tmp_path / "out", *asked, *flags)
        report = json.loads(said.stdout)
        touched = set(report["exempt_pieces"])
        if flags:
            assert (report["input"]["self_crossings"], report["input"]["components"], touched) == (
                0,
                1,
                set(),
            )
            assert report["input"]["resurfaced"]["off_mm"]["p99"] < 0.5
        else:
            assert report["input"]["self_crossings"] > 0
            assert report["checks"]["overlap_mm3"] > 1
            assert 2 <= len(touched) < len(report["pieces"])
            assert touched >= set(report["exempt"]["overlap_mm3"])
            assert said.returncode == 3
            assert "more than a tenth of the puzzle is exempt" in said.stderr
            assert "--resurface rebuilds its surface" in said.stderr
            assert set(report["failures"].pop("exempt")) <= touched
            assert not touched & {name for named in report["failures"].values() for name in named}


def bad_inputs(folder: Path):
    ball = sphere(500)
    nan = ball.V.copy()
    nan[:] = np.nan
    (folder / "empty.stl").write_bytes(b"")
    (folder / "notes.txt").write_text("no mesh")
    whole = saved(folder / "whole.stl", ball).read_bytes()
    (folder / "half.stl").write_bytes(whole[: len(whole) // 2])
    (folder / "points.ply").write_bytes(trimesh.PointCloud(ball.V).export(file_type="ply"))
    saved(folder / "nan.ply", ball._replace(V=nan))
    saved(folder / "flat.ply", ball._replace(V=ball.V * [0, 0, 1]))
    saved(folder / "strip.ply", moebius())
    return ball


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("missing.stl", "does not exist|not found|no such file|no file"),
        ("notes.txt", "format"),
        ("empty.stl", "empty"),
        ("half.stl", "cut off|truncated|ends"),
        ("points.ply", "points"),
        ("nan.ply", "NaN|finite|not a number|no number"),
        ("flat.ply", "area"),
        ("strip.ply", "orient"),
    ],
)
def test_a_bad_mesh_gets_one_sentence_and_leaves_nothing(name, words, tmp_path):
    bad_inputs(tmp_path)
    said = run("make", tmp_path / name, "-o", tmp_path / "out")
    assert_one_sentence(said, words, 4)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("flags", "words", "code"),
    [
        (["--pieces", 90000], "at most [0-9]+ pieces", 2),
        (["--thickness", 60], "thick", 1),
        (["--clearance", 8], "neck", 2),
    ],
)
def test_what_can_not_be_made_gets_one_sentence_and_leaves_nothing(flags, words, code, ball, tmp_path):
    said = run("make", ball, "-o", tmp_path / "out", *flags)
    assert_one_sentence(said, words, code)
    assert not list(tmp_path.iterdir())


def test_the_largest_number_of_pieces_that_is_said_to_work_works(tmp_path):
    mesh = saved(tmp_path / "can.ply", closed_cylinder(500))
    small = ("--size", 12, "--thickness", 0.4)
    said = run("make", mesh, "-o", tmp_path / "out", *small, "--pieces", 5000)
    most = int(re.search("at most ([0-9]+) pieces", said.stderr)[1])
    assert run(
        "make", mesh, "-o", tmp_path / "out", *small, "--pieces", most, "--assembly", "off"
    ).returncode in (0, 3)


def test_a_folder_of_somebody_else_is_left_alone(ball, tmp_path):
    (tmp_path / "precious").mkdir()
    (tmp_path / "precious/thesis.txt").write_text("years of work")
    assert_one_sentence(run("make", ball, "-o", tmp_path / "precious"), "not made by meshjig", 1)
    assert (tmp_path / "precious/thesis.txt").read_text() == "years of work"


def test_a_puzzle_is_replaced(puzzle, tmp_path, ball):
    target = tmp_path / "out"
    for pieces in (8, 12):
        run("make", ball, "-o", target, "--pieces", pieces, "--assembly", "off", "--no-guide", "--no-viewer")
    report = json.loads((target / "report.json").read_text())
    assert len(list((target / "pieces").iterdir())) == len(report["pieces"])
    assert report["options"]["pieces"] == 12


@pytest.mark.parametrize(
    "flags", [["--pieces", "0"], ["--tile", "round"], ["--nonsense"], ["--config", "none.toml"]]
)
def test_wrong_usage_exits_with_2(flags, ball):
    said = run("make", ball, *flags)
    assert said.returncode == 2
    assert "Traceback" not in said.stderr


def test_help_names_every_command():
    said = run("--help")
    assert all(command in said.stdout for command in ("make", "info", "check", "tiles", "view", "coupon"))
    assert run("--version").stdout.strip()


def assert_one_sentence(said, words, code):
    assert said.returncode == code, said.stderr
    lines = [line for line in said.stderr.strip().splitlines() if not line.startswith("size: ")]
    assert len(lines) == 1, said.stderr
    assert lines[0].startswith("meshjig: ")
    assert re.search(words, lines[0]), lines[0]
    assert said.stdout == ""


@pytest.mark.parametrize("wait", [0.3, 2.0])
def test_an_interrupt_ends_with_a_sentence_and_leaves_nothing(ball, tmp_path, wait):
    import signal
    import time

    command = [sys.executable, "-m", "meshjig", "make", str(ball), "-o", str(tmp_path / "out")]
    running = subprocess.Popen(command, stderr=subprocess.PIPE, encoding="utf-8")
    time.sleep(wait)
    running.send_signal(signal.SIGINT)
    _, said = running.communicate(timeout=60)
    assert running.returncode == 130, said
    assert "interrupted" in said
    assert "Traceback" not in said
    assert not list(tmp_path.iterdir())


def test_a_closed_surface_in_one_piece_is_refused(ball, tmp_path):
    assert_one_sentence(
        run("make", ball, "-o", tmp_path / "out", "--pieces", 1, "--charts", "single"), "hollow", 2
    )


def test_the_size_and_why_is_said_unless_it_is_to_be_quiet(tmp_path):
    mesh = saved(tmp_path / "ball.stl", sphere(500, 4.0))
    said = run("make", mesh, "--dry-run", "--unit", "inch").stderr
    assert re.fullmatch(r"size: \S+ x \S+ x \S+ mm; largest extent \S+ inch as asked\n", said)
    assert run("make", mesh, "--dry-run", "--unit", "inch", "-q").stderr == ""


@pytest.mark.parametrize("command", ["make", "info"])
def test_help_names_every_format_of_a_mesh(command):
    said = " ".join(run(command, "--help").stdout.split())
    assert "STL, OBJ, PLY, OFF, glTF, GLB or 3MF file" in said
