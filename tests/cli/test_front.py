"""The process in front of a run: signals, crashes and closed streams end in one true sentence."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
import trimesh

from tests.meshes import sphere

COMMAND = [sys.executable, "-P", "-m", "meshjig"]
CAUGHT = {"SIGINT", "SIGTERM", "SIGHUP"}
on_linux = pytest.mark.skipif(sys.platform != "linux", reason="/proc tells what a process listens to")


@pytest.fixture(scope="module")
def ball(tmp_path_factory):
    path = tmp_path_factory.mktemp("meshes") / "ball.ply"
    trimesh.Trimesh(*sphere(20_000), process=False).export(path)
    return path


def until(condition, seconds=60.0):
    """Wait for something; how long it takes is no matter."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it never came"
        time.sleep(0.002)


def listens(pid):
    """Tell whether a process catches the signals that ask for its end."""
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("SigCgt"):
            caught = int(line.split()[1], 16)
            return all(caught >> getattr(signal, name) - 1 & 1 for name in CAUGHT)
    return False


def started(*words, **more):
    return subprocess.Popen(
        [*COMMAND, *map(str, words)],
        stderr=subprocess.PIPE,
        encoding="utf-8",
        **{"stdout": subprocess.DEVNULL, **more},
    )


def at_stage(running, stage):
    """Read what --verbose says until a stage has ended."""
    said = ""
    while f"{stage}:" not in said:
        line = running.stderr.readline()
        assert line, said
        said += line
    return said


def descendants(running):
    return psutil.Process(running.pid).children(recursive=True)


def gone(processes):
    return all(not p.is_running() or p.status() == psutil.STATUS_ZOMBIE for p in processes)


@on_linux
@pytest.mark.parametrize("name", sorted(CAUGHT))
def test_a_run_can_be_ended_from_its_first_moments_on(ball, tmp_path, name):
    running = started("make", ball, "-o", tmp_path / "out", "--json", stdout=subprocess.PIPE)
    until(lambda: listens(running.pid))
    running.send_signal(getattr(signal, name))
    out, said = running.communicate(timeout=60)
    told = json.loads(out)
    assert (told["ok"], told["exit"]) == (False, 128 + getattr(signal, name))
    assert told["error"] == {
        "kind": "interrupted",
        "message": "interrupted; nothing was written",
        "hint": "",
        "stage": None,
    }
    assert said == "meshjig: interrupted; nothing was written\n"
    assert running.returncode == 128 + getattr(signal, name)
    assert not list(tmp_path.iterdir())


def test_the_front_listens_before_it_imports_anything_large():
    """Only what it then starts does: a signal may come while that is imported."""
    script = "import sys, meshjig.cli.front; print(*{name.split('.')[0] for name in sys.modules})"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, encoding="utf-8", check=True)
    assert not {"numpy", "typer", "pydantic", "trimesh", "subprocess"} & set(loaded.stdout.split())


@on_linux
@pytest.mark.parametrize("name", sorted(CAUGHT))
@pytest.mark.parametrize("stage", ["scan", "solid"])
def test_an_interrupt_leaves_the_old_puzzle_and_nothing_else(ball, tmp_path, name, stage):
    target = tmp_path / "deep" / "out"
    running = started("make", ball, "-o", target, "--pieces", 30, "--assembly", "off", "-v")
    at_stage(running, stage)
    processes = descendants(running)
    running.send_signal(getattr(signal, name))
    running.send_signal(getattr(signal, name))
    said = running.communicate(timeout=60)[1].splitlines()[-1]
    assert (running.returncode, said) == (
        128 + getattr(signal, name),
        "meshjig: interrupted; nothing was written",
    )
    until(lambda: gone(processes), 10)
    assert not list(tmp_path.iterdir())


@on_linux
def test_nothing_of_a_killed_run_goes_on_and_the_next_one_clears_up(ball, tmp_path):
    target = tmp_path / "out"
    running = started("make", ball, "-o", target, "--pieces", 30, "--assembly", "off", "-v")
    at_stage(running, "scan")
    processes = descendants(running)
    assert processes
    running.kill()
    running.communicate()
    until(lambda: gone(processes), 10)
    ended = started(
        "make", ball, "-o", target, "--pieces", 8, "--assembly", "off", "--no-guide", "--no-viewer"
    )
    said = ended.communicate(timeout=300)[1]
    assert ended.returncode in (0, 3), said
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@on_linux
@pytest.mark.parametrize("name", ["SIGSEGV", "SIGABRT", "SIGKILL"])
def test_a_crash_in_native_code_ends_in_a_sentence(ball, tmp_path, name):
    running = started("make", ball, "-o", tmp_path / "out", "-v", "--json", stdout=subprocess.PIPE)
    at_stage(running, "scan")
    worker = psutil.Process(running.pid).children()[0]
    worker.send_signal(getattr(signal, name))
    out, said = running.communicate(timeout=60)
    said, told = said.splitlines()[-1], json.loads(out)
    assert told["exit"] == running.returncode
    assert told["error"]["kind"] == ("killed" if name == "SIGKILL" else "bug")
    assert told["error"]["stage"] in ("scan", "cells")
    words = {"SIGSEGV": "a segmentation fault", "SIGABRT": "an abort", "SIGKILL": "was killed"}[name]
    assert said.startswith("meshjig: ")
    assert words in said
    assert "nothing was written" in said
    assert running.returncode == (128 + signal.SIGKILL if name == "SIGKILL" else 70)
    assert not list(tmp_path.iterdir())


def test_what_runs_in_the_background_of_a_shell_is_not_ended_by_its_signals(ball, tmp_path):
    """As nohup has it: what is ignored at the start stays ignored."""
    words = [*COMMAND, "info", str(ball), "-v"]
    ignore = "signal.signal(signal.SIGHUP, signal.SIG_IGN)"
    script = f"import os, signal; {ignore}; os.execv({words[0]!r}, {words!r})"
    running = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    until(lambda: len(psutil.Process(running.pid).children()) > 0)
    running.send_signal(signal.SIGHUP)
    out, said = running.communicate(timeout=120)
    assert running.returncode == 0, said
    assert b"faces" in out


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    path = tmp_path_factory.mktemp("meshes") / "small.ply"
    trimesh.Trimesh(*sphere(1500), process=False).export(path)
    return path


QUICK = ("--pieces", 8, "--assembly", "off", "--no-guide", "--no-viewer")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
def test_a_full_standard_output_does_not_hide_the_puzzle(small, tmp_path):
    target = tmp_path / "out"
    with Path("/dev/full").open("w") as full:
        ended = started("make", small, "-o", target, *QUICK, "--json", stdout=full)
        said = ended.communicate(timeout=300)[1]
    assert ended.returncode == 5  # that device is a full disk
    assert f"standard output can't be written (no space left on device); {target} is whole" in said
    assert "nothing was written" not in said
    assert json.loads((target / "report.json").read_text())["ok"] is not None


@on_linux
def test_a_full_disk_ends_in_one_sentence_and_leaves_nothing(small, tmp_path):
    """While files are written: a library that is told so in the middle of one once aborted."""
    limit = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))"
    words = [*COMMAND, "make", str(small), "-o", str(tmp_path / "out"), *map(str, QUICK), "--json"]
    script = f"{limit}; import os; os.execv({sys.executable!r}, {words!r})"
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, encoding="utf-8", check=False)
    told = json.loads(ended.stdout)
    assert ended.returncode == told["exit"] == 5, ended.stderr
    assert told["error"]["kind"] == "resources"
    said = [line for line in ended.stderr.splitlines() if not line.startswith("size: ")]
    assert said == [f"meshjig: {told['error']['message']}: {told['error']['hint']}"]
    assert "file too large" in ended.stderr
    assert not list(tmp_path.iterdir())


@on_linux
def test_a_name_that_is_no_text_is_no_hindrance(small, tmp_path):
    scan = os.fsencode(tmp_path) + b"/\xff.ply"
    Path(os.fsdecode(scan)).write_bytes(small.read_bytes())
    ended = started("make", os.fsdecode(scan), *QUICK, cwd=tmp_path)
    said = ended.communicate(timeout=300)[1]
    assert ended.returncode in (0, 3), said
    assert r"pieces in \udcff-jigsaw" in said
    report = json.loads((tmp_path / os.fsdecode(b"\xff-jigsaw") / "report.json").read_text(encoding="utf-8"))
    assert report["input"]["file"].endswith(r"\udcff.ply")


def test_a_reader_that_has_gone_away_does_not_matter(small, tmp_path):
    for words in (("make", small, "-o", tmp_path / "out", *QUICK, "--json"), ("info", small)):
        reading, writing = os.pipe()
        os.close(reading)
        ended = started(*words, stdout=writing)
        os.close(writing)
        said = ended.communicate(timeout=300)[1]
        assert ended.returncode in (0, 3), said
        assert "nothing was written" not in said
        assert "bug" not in said
    assert (tmp_path / "out/report.json").is_file()


@pytest.mark.parametrize("number", [0, 1, 2])
def test_closed_standard_streams_do_not_matter(small, tmp_path, number):
    words = [*COMMAND, "make", str(small), "-o", str(tmp_path / "out"), *map(str, QUICK)]
    script = f"import os; os.close({number}); os.execv({sys.executable!r}, {words!r})"
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, encoding="utf-8", check=False)
    assert ended.returncode in (0, 3), ended.stderr
    assert "pieces in" in ended.stderr or number == 2
    check = subprocess.run([*COMMAND, "check", str(tmp_path / "out")], capture_output=True, check=False)
    assert check.returncode == ended.returncode


def test_nothing_is_run_from_the_current_folder_or_the_callers_python(ball, tmp_path):
    trap = "import os, pathlib; pathlib.Path(__file__).with_suffix('.was_run').touch()\n"
    for name in ("typing.py", "numpy.py", "sitecustomize.py", "usercustomize.py", "meshjig.py", "pickle.py"):
        (tmp_path / name).write_text(trap)
    (tmp_path / "startup.py").write_text(trap)
    env = os.environ | {"PYTHONSTARTUP": str(tmp_path / "startup.py")}
    ended = started("make", ball, "-o", "out", "--pieces", 30, "--assembly", "off", cwd=tmp_path, env=env)
    said = ended.communicate(timeout=300)[1]
    assert ended.returncode in (0, 3), said
    assert not list(tmp_path.glob("*.was_run"))


def test_children_take_nothing_from_pythonpath(ball, tmp_path):
    """The caller's own interpreter has run what is there before it came to us; no child of ours does."""
    script = "import os, pathlib; pathlib.Path(__file__).with_suffix(f'.{os.getpid()}').touch()\n"
    (tmp_path / "sitecustomize.py").write_text(script)
    env = os.environ | {"PYTHONPATH": str(tmp_path)}
    ended = started("make", ball, "-o", tmp_path / "out", "--pieces", 30, "--assembly", "off", env=env)
    said = ended.communicate(timeout=300)[1]
    assert ended.returncode in (0, 3), said
    assert [path.name for path in tmp_path.glob("sitecustomize.*[0-9]")] == [f"sitecustomize.{ended.pid}"]


def test_a_scan_inside_the_puzzles_folder_is_never_lost(small, tmp_path):
    """A test of the whole way: `make out/scan.ply -o out` once deleted the scan."""
    target = tmp_path / "out"
    started("make", small, "-o", target, *QUICK).communicate(timeout=300)
    assert (target / "report.json").is_file()
    (target / "scan.ply").write_bytes(small.read_bytes())
    ended = started("make", target / "scan.ply", "-o", target, *QUICK)
    said = ended.communicate(timeout=60)[1]
    assert ended.returncode == 1
    assert "scan.ply" in said
    assert "-o" in said
    assert len(said.splitlines()) == 1
    assert (target / "scan.ply").read_bytes() == small.read_bytes()
