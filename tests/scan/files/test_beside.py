"""Files that a mesh names are found as they are meant."""

import os

import pytest

from meshjig.errors import InputError
from meshjig.scan.files.beside import find_beside, read_beside, short


@pytest.mark.parametrize(
    "name",
    [
        "a b.png",
        "a%20b.png",
        "sub/../a b.png",
        ".\\a b.png",
        "C:\\scans\\A B.PNG",
        "/home/me/a b.png",
        "sub/x/a%20b.png",
    ],
)
def test_a_file_is_found_by_what_programs_write(tmp_path, name):
    (tmp_path / "sub").mkdir()
    (tmp_path / "a b.png").write_bytes(b"here")
    assert read_beside(tmp_path / "model.obj", name) == b"here"


def test_the_exact_name_comes_first(tmp_path):
    (tmp_path / "a%20b.png").write_bytes(b"exact")
    (tmp_path / "a b.png").write_bytes(b"decoded")
    assert read_beside(tmp_path / "model.obj", "a%20b.png") == b"exact"


@pytest.mark.parametrize("name", ["", ".", "none.png", "x" * 5000, "a\0b", "sub", "sub/"])
def test_what_is_no_file_is_none(tmp_path, name):
    (tmp_path / "sub").mkdir()
    assert find_beside(tmp_path / "model.obj", name) is None
    assert read_beside(tmp_path / "model.obj", name) is None


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name here")
def test_a_pipe_is_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match="names pipe, which is no regular file"):
        find_beside(tmp_path / "model.obj", "pipe")


def test_a_long_name_is_cut_in_sentences():
    assert short("a.png") == "a.png"
    assert short("x" * 500) == "x" * 80 + "..."
