"""What a worker is told: options that change a result count, and drawings go along."""

import pickle

import pytest

from meshjig.fleet.task import Drawing, Task, Terms, drawing_of, options_digest, written_options
from meshjig.options import Options


def test_only_what_changes_the_result_counts():
    plain = options_digest(Options.of(), None)
    assert options_digest(Options.of(cores=1, memory=3.0), None) == plain
    assert options_digest(Options.of(pieces=100), None) == plain
    assert options_digest(Options.of(seed=1), None) != plain
    assert options_digest(Options.of(), Drawing("a.svg", b"x")) != plain
    assert written_options(Options.of(format="stl,ply"))["format"] == ["stl", "ply"]


@pytest.mark.parametrize("tile", ["{}", "isohedral:IH28:{}"])
def test_a_drawing_is_named_without_its_folder(tmp_path, tile):
    (tmp_path / "deep").mkdir()
    path = tmp_path / "deep" / "Mine.SVG"
    path.write_bytes(b"<svg/>")
    given, drawing = drawing_of({"tile": tile.format(path), "seed": 3})
    assert (given, drawing) == ({"tile": tile.format("Mine.SVG"), "seed": 3}, Drawing("Mine.SVG", b"<svg/>"))


@pytest.mark.parametrize("given", [{}, {"tile": "hex"}, {"tile": "isohedral:IH04"}])
def test_other_tilings_need_no_file(given):
    assert drawing_of(given) == (given, None)


def test_a_task_is_small_and_can_be_sent():
    task = Task("a", "/in/a.stl", {"pieces": 7}, Terms("/out", "1"))
    sent = pickle.dumps(task)
    assert pickle.loads(sent) == task
    assert len(sent) < 600
