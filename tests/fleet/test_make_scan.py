"""One scan of a batch: a record comes back of whatever happens, and what is there is not made again."""

import hashlib
import json
import os
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import psutil
import pytest

from meshjig.fleet import make_scan as module
from meshjig.fleet.make_scan import make_scan
from meshjig.fleet.scratch import scratch_folder, sweep
from meshjig.fleet.task import Drawing
from tests.fleet.scans import task, write_ball

pytestmark = pytest.mark.skipif(os.name != "posix", reason="Windows has no process groups")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """Make a ball once, and give its task and its record."""
    folder = tmp_path_factory.mktemp("batch")
    asked = task(write_ball(folder / "ball.ply"), folder / "out", name="deep/ball")
    return asked, make_scan(asked)


@pytest.fixture(autouse=True)
def quiet_place(tmp_path, monkeypatch):
    """Have temporary files where a test can see what is left of them."""
    place = tmp_path / "tmp"
    place.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(place))
    yield place
    assert not list(place.iterdir())


def test_a_sound_scan_is_made(done):
    asked, record = done
    folder = Path(asked.terms.out) / "deep" / "ball"
    report = json.loads((folder / "report.json").read_text())
    assert (record.outcome, record.exit, record.pieces, record.broken) == ("made", 0, 4, ())
    assert record.marks.input == report["input"]["sha256"]
    assert record.marks.input == hashlib.sha256(Path(asked.source).read_bytes()).hexdigest()
    assert report["options"]["cores"] == 1
    assert record.peak_mb > 100
    assert (Path(asked.terms.out) / "thumbnails" / "deep" / "ball.jpg").stat().st_size < 20_000


def test_what_is_there_is_kept(done):
    asked, record = done
    report = Path(asked.terms.out) / "deep" / "ball" / "report.json"
    inode = report.stat().st_ino
    for known in (None, record):
        again = make_scan(replace(asked, known=known))
        assert (again.kept, again.outcome, again.marks) == (True, "made", record.marks)
    assert again.seconds == record.seconds
    assert report.stat().st_ino == inode


@pytest.mark.parametrize("change", ["input", "options", "version", "drawing", "a file", "a missing file"])
def test_what_has_changed_is_not_kept(done, tmp_path, monkeypatch, change):
    asked, _ = done
    out = tmp_path / "out"
    subprocess.run(["cp", "-r", asked.terms.out, out], check=True)
    asked = replace(asked, terms=replace(asked.terms, out=str(out)))
    assert make_scan(asked).kept
    if change == "input":
        asked = replace(asked, source=str(write_ball(tmp_path / "ball.ply", scale=1.1)))
    elif change == "options":
        asked = replace(asked, given={**asked.given, "seed": 1})
    elif change == "version":
        asked = replace(asked, terms=replace(asked.terms, version="9"))
        monkeypatch.setattr(module, "meshjig_version", lambda: "9")
    elif change == "drawing":
        asked = replace(asked, drawing=Drawing("a.svg", b"<svg/>"))
    else:
        piece = out / "deep" / "ball" / "pieces" / "piece_001.stl"
        piece.unlink() if change == "a missing file" else piece.write_bytes(b"damaged")
    begun = []
    monkeypatch.setattr(module, "run_watched", lambda *_: begun.append(1))
    make_scan(asked)
    assert begun


def test_what_is_known_to_fail_is_not_tried_again(tmp_path, monkeypatch):
    (tmp_path / "bad.stl").write_text("nonsense")
    asked = task(tmp_path / "bad.stl", tmp_path / "out")
    record = make_scan(asked)
    assert (record.outcome, record.kind, record.exit, record.kept) == ("failed", "input", 4, False)
    assert "bad.stl is cut off" in record.sentence
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr(module, "run_watched", None)
    assert make_scan(replace(asked, known=record)) == replace(record, kept=True)


def test_options_that_are_wrong_are_not_begun(tmp_path):
    record = make_scan(task(tmp_path / "a.stl", tmp_path / "out", refused="row 3 of a.csv: pieces: no"))
    assert (record.kind, record.exit, record.sentence) == ("usage", 2, "row 3 of a.csv: pieces: no")


def test_a_worker_of_another_version_refuses(tmp_path):
    asked = task(write_ball(tmp_path / "ball.ply"), tmp_path / "out")
    record = make_scan(replace(asked, terms=replace(asked.terms, version="9")))
    assert (record.outcome, record.exit) == ("failed", None)
    assert "the batch 9" in record.sentence


def test_a_limit_of_time_is_named(tmp_path):
    record = make_scan(task(write_ball(tmp_path / "ball.ply"), tmp_path / "out", seconds=0.5))
    assert (record.kind, record.exit, record.signal) == ("time-out", None, None)
    assert "0.5 s of --timeout" in record.message
    assert not (tmp_path / "out").exists()


def test_a_limit_of_memory_is_named(tmp_path):
    record = make_scan(task(write_ball(tmp_path / "ball.ply"), tmp_path / "out", memory=0.05))
    assert (record.kind, record.exit) == ("resources", 5)
    assert "--memory" in record.message


OWNER = """
from meshjig.fleet.make_scan import make_scan
from tests.fleet.scans import task
import sys, tempfile
tempfile.tempdir = sys.argv[3]
make_scan(task(sys.argv[1], sys.argv[2], given={"pieces": 30}))
"""


def test_with_its_owner_the_run_and_all_that_it_began_are_gone(tmp_path, quiet_place):
    ball = write_ball(tmp_path / "ball.ply", faces=20_000)
    words = [sys.executable, "-c", OWNER, str(ball), str(tmp_path / "out"), str(quiet_place)]
    owner = psutil.Popen(words)
    wait(lambda: len(owner.children(recursive=True)) > 2)
    family = owner.children(recursive=True)
    owner.kill()
    owner.wait()
    wait(lambda: all(not p.is_running() or p.status() == psutil.STATUS_ZOMBIE for p in family))
    wait(lambda: not list(quiet_place.iterdir()))
    assert not (tmp_path / "out").exists()


def wait(condition, seconds=40.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_folders_of_killed_owners_are_swept_away_others_stay(quiet_place):
    script = "import os\nfrom meshjig.fleet.scratch import *\nwith scratch_folder(): os._exit(0)"
    command = [sys.executable, "-c", script]
    subprocess.run(command, env=os.environ | {"TMPDIR": str(quiet_place)}, check=True)
    left = list(quiet_place.iterdir())
    assert len(left) == 1
    with scratch_folder() as ours:
        sweep()
        assert ours.exists()
        assert not left[0].exists()
