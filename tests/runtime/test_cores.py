"""How many cores a run may use, and what it does with one."""

import os
import subprocess
import sys
from pathlib import Path

import psutil
import pytest
import trimesh

import meshjig
from meshjig.runtime.cores import VARIABLE, cores, thread_limits, use_cores
from meshjig.runtime.worker import Background
from tests.meshes import sphere


def test_the_nearest_word_counts(monkeypatch):
    monkeypatch.delenv(VARIABLE, raising=False)
    everything = cores()
    assert everything >= 1
    monkeypatch.setenv(VARIABLE, " 3 ")
    assert cores() == 3
    with use_cores(2):
        assert cores() == 2
        with use_cores(None):
            assert cores() == 2
    assert cores() == 3
    assert set(thread_limits(1).values()) == {"1"}
    assert {VARIABLE, "OMP_NUM_THREADS"} <= set(thread_limits(1))


@pytest.mark.parametrize("value", ["0", "-1", "two", "1.5"])
def test_what_is_no_number_of_cores_is_refused_by_name(monkeypatch, value):
    monkeypatch.setenv(VARIABLE, value)
    with pytest.raises(meshjig.OptionError, match=f"{VARIABLE} is '{value}'"):
        cores()


def test_one_core_starts_no_second_process():
    before = set(psutil.Process().children())
    with use_cores(1):
        work = Background(os.getpid)
        assert set(psutil.Process().children()) == before
        assert work.result() == os.getpid()
    with use_cores(2):
        assert Background(os.getpid).result() != os.getpid()


@pytest.mark.parametrize(("words", "environment"), [(["--cores", "1"], {}), ([], {VARIABLE: "1"})])
def test_a_run_on_one_core_makes_the_same_puzzle(tmp_path, words, environment):
    mesh = tmp_path / "ball.ply"
    trimesh.Trimesh(*sphere(300), process=False).export(mesh)
    common = ["make", str(mesh), "--pieces", "4", "--no-viewer", "--no-guide", "--format", "stl"]
    for name, more, env in (("one", words, environment), ("all", ["--cores", "2"], {})):
        subprocess.run(
            [sys.executable, "-m", "meshjig", *common, "-q", *more, "-o", str(tmp_path / name)],
            env=os.environ | env,
            check=True,
        )
    one, other = (files(tmp_path / name) for name in ("one", "all"))
    assert one == other


def files(folder: Path):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != "report.json"
    }


def test_an_environment_that_is_wrong_ends_in_a_sentence(tmp_path):
    said = subprocess.run(
        [sys.executable, "-m", "meshjig", "make", "none.stl", "-o", str(tmp_path / "out")],
        env=os.environ | {VARIABLE: "many"},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    assert said.returncode == 2
    assert (
        said.stderr == "meshjig: MESHJIG_CORES is 'many', no number of cores: give at least 1, or unset it\n"
    )
