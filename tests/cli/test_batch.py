"""The command that makes puzzles of many scans."""

import csv
import json
import os
import signal
import subprocess
import sys
import time

import psutil
import pytest

from tests.fleet.scans import write_ball

pytestmark = pytest.mark.skipif(os.name != "posix", reason="Windows has no process groups")
COMMAND = [sys.executable, "-P", "-m", "meshjig", "batch"]
QUICK = ["--pieces", "4", "--no-viewer", "--no-guide", "--format", "stl"]


def run(*words, **more):
    return subprocess.run(
        [*COMMAND, *map(str, words)], capture_output=True, encoding="utf-8", check=False, timeout=200, **more
    )


@pytest.mark.parametrize(
    ("words", "code", "says"),
    [
        (["a.stl"], 2, "batch needs a folder for its puzzles: give one with -o DIR"),
        (["-o", "out"], 4, "there is no scan: give files, folders, patterns, or a list with --from"),
        (
            ["a.stl", "-o", "out", "--shard", "half"],
            2,
            "--shard: 'half' is no share: write 1/8",
        ),
        (["a.stl", "-o", "out", "--shard", "1/2", "--workers", "2"], 2, "--shard works one after another"),
        (["a.stl", "-o", "out", "--pieces", "0"], 2, "--pieces: '0' is too small: give at least 1"),
        (["a.stl", "-o", "out", "--scheduler", "tcp://a:1", "--scheduler-file", "f"], 2, "name two clusters"),
        (["a.stl", "-o", "out", "--scheduler-file", "none"], 2, "none is no file"),
        (["a.stl", "-o", "out", "--retrys", "1"], 2, "there is no option --retrys: did you mean --retries?"),
    ],
)
def test_what_is_wrong_is_said_in_a_sentence(tmp_path, words, code, says):
    said = run(*words, cwd=tmp_path)
    assert (said.returncode, said.stdout) == (code, "")
    assert says in said.stderr
    assert len(said.stderr.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_a_share_needs_no_dask(tmp_path):
    write_ball(tmp_path / "in" / "ball.ply")
    (tmp_path / "in" / "bad.stl").write_text("nonsense")
    without = tmp_path / "site"
    without.mkdir()
    for name in ("dask", "distributed", "fsspec"):
        (without / f"{name}.py").write_text("raise ImportError('not here')\n")
    out = tmp_path / "out"
    words = [tmp_path / "in", "-o", out, *QUICK, "--shard", "1/1", "--json"]
    said = run(*words, env=os.environ | {"PYTHONPATH": f"{without}:{os.environ.get('PYTHONPATH', '')}"})
    summary = json.loads(said.stdout)
    assert said.returncode == summary["exit"] == 1
    assert (summary["made"], summary["failed"], summary["failures"]) == (1, 1, {"input": 1})
    assert said.stderr.splitlines()[0].startswith("meshjig: bad: ")
    assert "2 scans, 1 made, 1 failed (input 1); see" in said.stderr
    with (out / "summary.csv").open(newline="") as file:
        assert [row["name"] for row in csv.DictReader(file)] == ["bad", "ball"]
    again = json.loads(run(*words).stdout)
    assert again["kept"] == 2


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize("how", [["--shard", "1/1"], ["--workers", "1"]])
def test_a_signal_ends_it_in_two_seconds_and_says_how_to_go_on(tmp_path, name, how):
    if "--workers" in how:
        pytest.importorskip("distributed")
    write_ball(tmp_path / "in" / "ball.ply", faces=20_000)
    (tmp_path / "tmp").mkdir()
    out = tmp_path / "out"
    process = psutil.Popen(
        [*COMMAND, str(tmp_path / "in"), "-o", str(out), "--pieces", "30", *how],
        stderr=subprocess.PIPE,
        env=os.environ | {"TMPDIR": str(tmp_path / "tmp")},
    )
    wait(lambda: any("run_for" in " ".join(p.cmdline()) for p in children(process)))
    family = children(process)
    begun = time.monotonic()
    process.send_signal(getattr(signal, name))
    said = process.communicate(timeout=30)[1].decode()
    assert time.monotonic() - begun < 4  # it takes less than two where nothing else runs
    assert process.returncode == 128 + getattr(signal, name)
    assert said == f"meshjig: interrupted; what is done is in {out}, and the same command does the rest\n"
    wait(lambda: all(not p.is_running() or p.status() == psutil.STATUS_ZOMBIE for p in family))
    wait(lambda: not list((tmp_path / "tmp").iterdir()), 10)
    assert {path.name for path in out.iterdir()} == {"batch.jsonl"}


def children(process):
    found = []
    for one in process.children(recursive=True):
        try:
            one.cmdline()
        except psutil.Error:
            continue
        found.append(one)
    return found


def wait(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)
