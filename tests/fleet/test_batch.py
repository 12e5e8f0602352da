"""A batch: every scan once, what failed by the machine again, and nothing twice when it is begun again."""

import json
import os

import pytest

from meshjig.errors import InputError, OptionError, OutputError
from meshjig.fleet import batch as module
from meshjig.fleet import one_by_one
from meshjig.fleet.batch import Batch, batch
from meshjig.fleet.settings import BatchSettings, Shard
from tests.fleet.scans import failed, made

pytestmark = pytest.mark.skipif(os.name != "posix", reason="Windows has no process groups")


@pytest.fixture
def scans(tmp_path, monkeypatch):
    """Write some scans, and have them made by a table of what becomes of each."""
    (tmp_path / "in").mkdir()
    for i in range(6):
        (tmp_path / "in" / f"s{i}.stl").write_text("x")
    outcomes, asked = {}, []

    def make(task):
        asked.append(task)
        if task.known is not None and task.known.outcome == "made":
            return made(task.name, kept=True)
        left = outcomes.get(task.name, [])
        return (left.pop(0) if left else made)(task.name, attempts=task.attempt)

    monkeypatch.setattr(one_by_one, "make_scan", make)
    return tmp_path, outcomes, asked


def run(folder, settings=None, **options):
    made_of = Batch([str(folder / "in")], str(folder / "out"), None, settings or BatchSettings(), options)
    return made_of, {record.name: record for record in made_of}


def crash(name, **more):
    return failed(name, kind="killed", exit=None, signal=9, **more)


def events(folder, name="batch.jsonl"):
    return [json.loads(line) for line in (folder / "out" / name).read_text().splitlines()]


def test_every_scan_has_a_record_and_a_line(scans):
    folder, outcomes, _ = scans
    outcomes["s2"] = [failed]
    done, records = run(folder)
    assert sorted(records) == [f"s{i}" for i in range(6)]
    assert (done.tally.made, done.tally.failed, done.total()) == (5, 1, 6)
    lines = events(folder)
    assert [line["event"] for line in lines] == ["begin", *["scan"] * 6, "end"]
    assert {path.name for path in (folder / "out").iterdir()} >= {"summary.csv", "index.html"}


def test_what_fails_by_the_machine_is_tried_again_and_only_that(scans):
    folder, outcomes, asked = scans
    outcomes.update(s0=[crash], s1=[crash, crash, crash], s2=[failed])
    done, records = run(folder, BatchSettings(retries=2))
    assert [task.name for task in asked].count("s2") == 1
    assert (records["s0"].outcome, records["s0"].attempts) == ("made", 2)
    assert (records["s1"].kind, records["s1"].attempts) == ("killed", 3)
    assert [line["event"] for line in events(folder)].count("retry") == 3 == done.tally.retried


def test_begun_again_nothing_is_written_twice(scans):
    folder, outcomes, asked = scans
    outcomes["s1"] = [crash, crash]
    run(folder)
    size = len(events(folder))
    asked.clear()
    done, records = run(folder)
    assert all(task.known is not None for task in asked)
    assert (done.tally.kept, records["s1"].outcome) == (5, "made")
    assert [line["event"] for line in events(folder)[size:]] == ["begin", "scan", "end"]
    assert len((folder / "out" / "summary.csv").read_text().splitlines()) == 7


def test_shares_make_the_whole_and_the_whole_knows_of_them(scans):
    folder, _, asked = scans
    parts = [run(folder, BatchSettings(shard=Shard(i, 4)))[1] for i in (1, 2, 3, 4)]
    assert sorted(name for part in parts for name in part) == [f"s{i}" for i in range(6)]
    assert [len(part) for part in parts] == [2, 2, 1, 1]
    assert len(events(folder, "batch-4-of-4.jsonl")) == 3
    asked.clear()
    done, _ = run(folder)
    assert all(task.known is not None for task in asked)
    assert done.tally.kept == 6
    assert len((folder / "out" / "summary.csv").read_text().splitlines()) == 7


def test_a_list_may_have_options_of_its_own(scans):
    folder, _, asked = scans
    (folder / "list.csv").write_text(
        f"file,pieces,memory\n{folder}/a.stl,7,\n{folder}/b.stl,none,\n{folder}/c.stl,,2\n"
    )
    (folder / "in2").mkdir()
    done = Batch(
        [], str(folder / "out"), None, BatchSettings(listed=folder / "list.csv"), {"piece_size": 9.0}
    )
    assert len(list(done)) == 3
    a, b, c = asked
    assert a.given == {"pieces": "7"}
    assert "row 2 of" in b.refused
    assert "pieces: 'none' is no whole number" in b.refused
    assert (c.given["piece_size"], c.terms.memory, a.terms.memory) == (9.0, 2.0, 4.0)


def test_a_drawing_goes_along(scans):
    folder, _, asked = scans
    (folder / "mine.svg").write_text("<svg/>")
    run(folder, tile=str(folder / "mine.svg"))
    assert (asked[0].given["tile"], asked[0].drawing.data) == ("mine.svg", b"<svg/>")
    with pytest.raises(OptionError, match=r"tile: .*none\.svg can't be read"):
        run(folder, tile=str(folder / "none.svg"))


def test_two_batches_do_not_write_to_one_folder(scans):
    folder, _, _ = scans
    first = iter(Batch([str(folder / "in")], str(folder / "out"), None, BatchSettings(), {}))
    next(first)
    with pytest.raises(OutputError, match="another batch is writing"):
        run(folder)
    first.close()
    run(folder)


@pytest.mark.parametrize(
    ("make", "error", "says"),
    [
        (lambda folder: batch([], folder), InputError, "there is no scan"),
        (lambda folder: batch(["a.stl"], folder, pieces=0), OptionError, "^pieces"),
        (lambda folder: batch(["a.stl"], folder / "file"), OptionError, "is a file, not a folder"),
        (lambda folder: BatchSettings(timeout=0), OptionError, "--timeout: 0 is too small"),
        (lambda folder: BatchSettings(retries=-1), OptionError, "--retries"),
        (lambda folder: BatchSettings(timeout=float("nan")), OptionError, "--timeout"),
        (lambda folder: Shard(3, 2), OptionError, "3/2 is no share"),
    ],
)
def test_what_is_wrong_is_said_before_anything_is_begun(tmp_path, make, error, says):
    (tmp_path / "file").write_text("")
    with pytest.raises(error, match=says):
        make(tmp_path)


def test_a_puzzle_elsewhere_has_its_journal_here(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert module.Batch(["a.stl"], "memory://bucket/deep", None, BatchSettings(), {}).journal_path.name == (
        "deep.batch.jsonl"
    )
