"""What words of a command line stand for."""

import pytest

from meshjig.errors import InputError
from meshjig.fleet.inputs import entries, expand


@pytest.fixture
def folder(tmp_path, monkeypatch):
    for name in (
        "a/x.stl",
        "b/x.stl",
        "b/y.PLY",
        "b/notes.txt",
        ".hidden/z.stl",
        "out/x/pieces/p.stl",
        "b/.z.stl",
    ):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("x")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def named(inputs, rows=()):
    return {name: entry.source for name, entry in entries(inputs, rows)}


def test_a_folder_is_searched_but_for_what_the_batch_makes(folder):
    found = named(expand(["."], "out"))
    assert found == {"a/x": f"{folder}/a/x.stl", "b/x": f"{folder}/b/x.stl", "y": f"{folder}/b/y.PLY"}


def test_patterns_files_and_urls(folder):
    found = named(
        expand(["*/x.*", "b/y.PLY", "s3://scans/deep/one.glb", "https://a.org/b%20c.stl?v=1"], "out")
    )
    assert found["a/x"] == f"{folder}/a/x.stl"
    assert found["y"] == f"{folder}/b/y.PLY"
    assert found["one"] == "s3://scans/deep/one.glb"


def test_a_folder_without_scans_is_refused(folder):
    with pytest.raises(InputError, match=r"\.hidden/none|holds no scan"):
        expand(["*.nothing"], "out")


def test_folders_and_patterns_behind_urls():
    import fsspec

    memory = fsspec.filesystem("memory")
    for name in ("/scans/a/x.stl", "/scans/b/x.stl", "/scans/readme.md"):
        memory.pipe(name, b"x")
    assert set(named(expand(["memory://scans/"], "memory://out"))) == {"a/x", "b/x"}
    assert set(named(expand(["memory://scans/a/*"], "memory://out"))) == {"x"}
    memory.rm("/scans", recursive=True)
