import json

import pytest

from meshjig.errors import OutputError
from meshjig.output.folder import replace_folder


def fill(folder, text="new"):
    (folder / "report.json").write_text(json.dumps({"meshjig": "0", "text": text}))
    (folder / "pieces").mkdir()
    (folder / "pieces" / "a.stl").write_text(text)


def write_and(target, error=None, meanwhile=lambda: None):
    with replace_folder(target) as folder:
        fill(folder)
        meanwhile()
        if error:
            raise error


def tree(folder):
    return {str(p.relative_to(folder)): p.read_text() for p in folder.rglob("*") if p.is_file()}


def test_a_new_folder_appears_only_at_the_end(tmp_path):
    target = tmp_path / "a" / "b" / "out"
    with replace_folder(target) as folder:
        fill(folder)
        assert not target.exists()
    assert (target / "pieces" / "a.stl").read_text() == "new"
    assert [p.name for p in target.parent.iterdir()] == ["out"]


def test_our_own_folder_is_replaced_whole(tmp_path):
    target = tmp_path / "out"
    with replace_folder(target) as folder:
        fill(folder, "old")
        (folder / "left over").write_text("old")
    with replace_folder(target) as folder:
        fill(folder)
    assert set(tree(target)) == {"report.json", "pieces/a.stl"}
    assert (target / "pieces" / "a.stl").read_text() == "new"
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, OSError(28, "No space left on device")])
@pytest.mark.parametrize("before", [True, False], ids=["over our own", "new"])
def test_failure_leaves_everything_as_it_was(tmp_path, error, before):
    target = tmp_path / "deep" / "out" if not before else tmp_path / "out"
    if before:
        with replace_folder(target) as folder:
            fill(folder, "old")
    was = tree(tmp_path)
    expected = OutputError if isinstance(error, OSError) else error
    with pytest.raises(expected):
        write_and(target, error)
    assert tree(tmp_path) == was
    assert [p.name for p in tmp_path.iterdir()] == (["out"] if before else [])


@pytest.mark.parametrize("content", [None, "not json", "[]", '{"other": 1}'])
def test_a_foreign_folder_is_left_alone(tmp_path, content):
    target = tmp_path / "out"
    target.mkdir()
    (target / "thesis.txt").write_text("dear to me")
    if content is not None:
        (target / "report.json").write_text(content)
    was = tree(tmp_path)
    with pytest.raises(OutputError, match="not made by meshjig"), replace_folder(target):
        pytest.fail("the block must not run")
    assert tree(tmp_path) == was


def test_what_turns_foreign_meanwhile_is_left_alone(tmp_path):
    target = tmp_path / "out"

    def somebody_writes():
        target.mkdir()
        (target / "thesis.txt").write_text("dear to me")

    with pytest.raises(OutputError, match="not made by meshjig"):
        write_and(target, meanwhile=somebody_writes)
    assert tree(tmp_path) == {"out/thesis.txt": "dear to me"}


def test_an_empty_folder_is_filled(tmp_path):
    target = tmp_path / "out"
    target.mkdir()
    with replace_folder(target) as folder:
        fill(folder)
    assert (target / "pieces" / "a.stl").exists()


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real")
    with replace_folder(tmp_path / "link") as folder:
        fill(folder)
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real" / "report.json").exists()


@pytest.mark.parametrize("inside", ["", "below", "below/that"])
def test_a_file_in_the_way_is_told(tmp_path, inside):
    (tmp_path / "file").write_text("dear to me")
    with pytest.raises(OutputError, match="file"), replace_folder(tmp_path / "file" / inside):
        pytest.fail("the block must not run")
    assert tree(tmp_path) == {"file": "dear to me"}


def test_a_folder_that_holds_something_else_of_meshjig_is_left_alone(tmp_path):
    target = tmp_path / "puzzle"
    target.mkdir()
    (target / "report.json").write_text('{"meshjig": "1", "kind": "puzzle"}')
    with pytest.raises(OutputError, match="holds a puzzle"), replace_folder(target, "coupon"):
        pass
    assert [p.name for p in tmp_path.iterdir()] == ["puzzle"]
    with replace_folder(target) as folder:
        (folder / "new").touch()
    assert [p.name for p in target.iterdir()] == ["new"]
