import errno
import json
import os
import re
import stat
import subprocess
import sys
from types import SimpleNamespace

import pytest

from meshjig.errors import OutputError, ResourceError
from meshjig.output.folder import replace_folder


def fill(folder, text="new"):
    (folder / "report.json").write_text(json.dumps({"meshjig": "0", "kind": "puzzle", "text": text}))
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
        (folder / "more").write_text("old")
    with replace_folder(target) as folder:
        fill(folder)
    assert set(tree(target)) == {"report.json", "pieces/a.stl"}
    assert set(json.loads((target / "report.json").read_text())["files"]) == {"report.json", "pieces/a.stl"}
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
    expected = ResourceError if isinstance(error, OSError) else error
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
    write_and(target)
    was = tree(tmp_path)
    with pytest.raises(OutputError, match="holds a puzzle"), replace_folder(target, "coupon"):
        pytest.fail("the block must not run")
    assert tree(tmp_path) == was


@pytest.mark.parametrize("name", ["notes.txt", "pieces/photo.jpg", "photos/a/b.jpg", ".hidden"])
def test_what_somebody_put_into_our_folder_is_left_alone(tmp_path, name):
    target = tmp_path / "out"
    write_and(target)
    (target / name).parent.mkdir(parents=True, exist_ok=True)
    (target / name).write_text("dear to me")
    was = tree(tmp_path)
    first = name.split("/")[0] if name.startswith("photos") else name
    with pytest.raises(OutputError, match=f"{first} was not .* by meshjig.* -o"), replace_folder(target):
        pytest.fail("the block must not run")
    assert tree(tmp_path) == was


@pytest.mark.parametrize("name", ["pieces/a.stl", "report.json"])
def test_a_file_of_ours_that_somebody_changed_is_left_alone(tmp_path, name):
    target = tmp_path / "out"
    write_and(target)
    (target / name).write_text((target / name).read_text() + " ")
    was = tree(tmp_path)
    with pytest.raises(OutputError, match=f"{name} was changed since"), replace_folder(target):
        pytest.fail("the block must not run")
    assert tree(tmp_path) == was


def test_a_link_in_place_of_a_file_of_ours_is_left_alone(tmp_path):
    target = tmp_path / "out"
    write_and(target)
    (tmp_path / "mine.stl").write_text("new")
    (target / "pieces/a.stl").unlink()
    (target / "pieces/a.stl").symlink_to(tmp_path / "mine.stl")
    with pytest.raises(OutputError, match=r"a\.stl was changed"), replace_folder(target):
        pytest.fail("the block must not run")
    assert (target / "pieces/a.stl").is_symlink()


def test_a_folder_is_ours_by_its_list_only(tmp_path):
    target = tmp_path / "out"
    target.mkdir()
    (target / "report.json").write_text('{"meshjig": 1}')
    with pytest.raises(OutputError, match=r"not made by meshjig.*report\.json.* -o"), replace_folder(target):
        pytest.fail("the block must not run")
    assert tree(target) == {"report.json": '{"meshjig": 1}'}


def test_what_is_missing_of_our_folder_does_not_keep_it(tmp_path):
    target = tmp_path / "out"
    write_and(target)
    (target / "pieces/a.stl").unlink()
    write_and(target)
    assert (target / "pieces/a.stl").read_text() == "new"


@pytest.mark.parametrize("link", [False, True])
def test_an_input_inside_the_target_is_refused(tmp_path, link):
    target = tmp_path / "out"
    write_and(target)
    given = target / "pieces/a.stl"
    if link:
        (tmp_path / "link.stl").symlink_to(given)
        given = tmp_path / "link.stl"
    was = tree(tmp_path)
    with (
        pytest.raises(OutputError, match=r"input .*stl lies in .* -o"),
        replace_folder(target, inputs=[given]),
    ):
        pytest.fail("the block must not run")
    assert tree(tmp_path) == was


@pytest.mark.parametrize(
    ("below", "words"),
    [
        ("", "^{0} is a file, not a folder: choose another folder with -o$"),
        ("x/y", r"^the output folder {0}/x/y can't be written \({0} is a file, not a folder\): choose"),
    ],
)
def test_the_input_itself_is_no_folder(tmp_path, below, words):
    given = tmp_path / "b.ply"
    given.write_text("dear to me")
    with (
        pytest.raises(OutputError, match=words.format(re.escape(str(given)))),
        replace_folder(given / below, inputs=[given]),
    ):
        pytest.fail("the block must not run")
    assert tree(tmp_path) == {"b.ply": "dear to me"}


@pytest.mark.skipif(not hasattr(os, "statvfs"), reason="nothing tells of disks here")
@pytest.mark.parametrize(
    ("flag", "words"),
    [
        (getattr(os, "ST_RDONLY", 1), r"is on a disk that can only be read\): .* another disk with -o"),
        (0, r"\(you have no permission to write to .*\): choose another with -o"),
    ],
)
def test_why_a_folder_is_closed_is_told(tmp_path, monkeypatch, flag, words):
    monkeypatch.setattr(os, "access", lambda *_: False)
    monkeypatch.setattr(os, "statvfs", lambda _: SimpleNamespace(f_flag=flag))
    with pytest.raises(OutputError, match=words), replace_folder(tmp_path / "out"):
        pytest.fail("the block must not run")


def test_a_file_that_comes_at_the_last_moment_is_kept(tmp_path, monkeypatch):
    """It comes after the last look, and is found once the old folder has left its place: that goes back."""
    target = tmp_path / "out"
    write_and(target)
    looks = iter([lambda: None, lambda: (target / "late.txt").write_text("dear to me")])
    monkeypatch.setattr("meshjig.output.folder.replace._refuse_foreign", lambda *_: next(looks)())
    with pytest.raises(OutputError, match=r"late\.txt was not written"):
        write_and(target)
    assert (target / "late.txt").read_text() == "dear to me"
    assert (target / "pieces/a.stl").read_text() == "new"
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_a_second_run_into_the_same_folder_is_refused(tmp_path):
    target = tmp_path / "out"
    script = f"""
import sys
from meshjig.output.folder import reserve_folder
with reserve_folder({str(target)!r}):
    print("here", flush=True)
    sys.stdin.read()
"""
    command = [sys.executable, "-c", script]
    other = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert other.stdout.readline() == b"here\n"
    with pytest.raises(OutputError, match="another run of meshjig is writing to"), replace_folder(target):
        pytest.fail("the block must not run")
    other.kill()  # the lock dies with its owner
    other.communicate()
    write_and(target)
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_the_mode_of_an_empty_folder_stays(tmp_path):
    target = tmp_path / "out"
    target.mkdir(mode=0o700)
    write_and(target)
    assert stat.S_IMODE(target.stat().st_mode) == 0o700


@pytest.mark.parametrize("inside", ["", "below/that"])
def test_a_link_that_leads_to_itself_is_told(tmp_path, inside):
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    with (
        pytest.raises(OutputError, match="loop is a link that leads to itself: choose another"),
        replace_folder(tmp_path / "loop" / inside),
    ):
        pytest.fail("the block must not run")
    assert [path.name for path in tmp_path.iterdir()] == ["loop"]


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EFBIG])
def test_a_full_disk_is_a_want_of_resources(tmp_path, code):
    with pytest.raises(
        ResourceError, match=r"out can't be written \(.*\): choose another with -o, or make room"
    ):
        write_and(tmp_path / "out", OSError(code, os.strerror(code)))
    assert not list(tmp_path.iterdir())


def test_an_empty_folder_keeps_who_may_read_it(tmp_path):
    (tmp_path / "out").mkdir(mode=0o700)
    with replace_folder(tmp_path / "out") as folder:
        fill(folder)
    assert stat.S_IMODE((tmp_path / "out").stat().st_mode) == 0o700


def test_where_a_disk_is_mounted_nothing_is_put(tmp_path, monkeypatch):
    (tmp_path / "disk").mkdir()
    monkeypatch.setattr(os.path, "ismount", lambda path: str(path).endswith("disk"))
    with (
        pytest.raises(OutputError, match="disk is where a disk is mounted: choose a folder in it"),
        replace_folder(tmp_path / "disk"),
    ):
        pytest.fail("the block must not run")


@pytest.mark.parametrize("length", [200, 245, 255])
def test_a_long_name_is_taken(tmp_path, length):
    """A scratch folder beside the target, with a longer name than its own, once failed at the end."""
    target = tmp_path / ("n" * length)
    write_and(target)
    assert [path.name for path in tmp_path.iterdir()] == [target.name]


@pytest.mark.parametrize("length", [256, 4000])
def test_a_name_too_long_is_refused_before_the_work(tmp_path, length):
    with pytest.raises(OutputError, match="-o"), replace_folder(tmp_path / ("n" * length)):
        pytest.fail("the block must not run")


def test_a_name_too_long_leaves_nothing_behind(tmp_path):
    with pytest.raises(OutputError), replace_folder(tmp_path / ("n" * 256)):
        pytest.fail("the block must not run")
    assert not list(tmp_path.iterdir())
