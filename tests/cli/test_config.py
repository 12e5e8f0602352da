"""A config file gives options; one that is wrong, or made to hurt, ends in a sentence and exit code 2."""

import os

import pytest
import typer

from meshjig.cli.config import read_options


def given(folder, text):
    (folder / "shop.toml").write_text(text)
    return folder / "shop.toml"


def test_flags_win_over_the_file(tmp_path):
    options = read_options(given(tmp_path, "pieces = 30\nmin-wall = 0.9\n"), {"pieces": 12})
    assert (options.pieces, options.min_wall) == (12, 0.9)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("pieces = ", "no valid TOML"),
        ("a = " + "[" * 50_000 + "]" * 50_000, "nested too deeply"),
        (".".join(["a"] * 20_000) + " = 1", "GB of memory|takes more than|crash"),
        ("pieces = " + "9" * 5000, "too many digits"),
        ("sise = 150", "sise"),
    ],
)
def test_a_bad_file_ends_in_a_sentence(tmp_path, capsys, text, words):
    with pytest.raises(typer.Exit) as ending:
        read_options(given(tmp_path, text), {})
    assert ending.value.exit_code == 2
    said = capsys.readouterr().err
    assert len(said.splitlines()) == 1
    assert any(word in said for word in words.split("|")), said


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name here")
def test_a_pipe_is_no_file(tmp_path, capsys):
    os.mkfifo(tmp_path / "pipe.toml")
    with pytest.raises(typer.Exit):
        read_options(tmp_path / "pipe.toml", {})
    assert "is no file" in capsys.readouterr().err
