"""A config file gives options; one that is wrong, or made to hurt, ends in a sentence."""

import os

import pytest

from meshjig.cli.config import read_options
from meshjig.errors import OptionError


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
        ("sise = 150", "sise: there is no such option: did you mean size?"),
        ("[process.x]\nclearence = 0.1", "x sets 'clearence'; a process has"),
    ],
)
def test_a_bad_file_ends_in_a_sentence(tmp_path, text, words):
    with pytest.raises(OptionError) as error:
        read_options(given(tmp_path, text), {})
    said = str(error.value)
    assert len(said.splitlines()) == 1
    assert any(word in said for word in words.split("|")), said
    assert "shop.toml" in said


@pytest.mark.parametrize("coding", ["utf-8", "utf-8-sig"])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_a_byte_order_mark_is_passed_over(tmp_path, coding, end):
    (tmp_path / "shop.toml").write_bytes(f"# größer{end}pieces = 30{end}".encode(coding))
    assert read_options(tmp_path / "shop.toml", {}).pieces == 30


@pytest.mark.parametrize("coding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_utf_16_is_refused_in_a_sentence(tmp_path, coding):
    file = tmp_path / "shop.toml"
    file.write_bytes("pieces = 30\n".encode(coding))
    with pytest.raises(OptionError) as error:
        read_options(file, {})
    assert str(error.value) == f"--config: {file} is in UTF-16: save it as UTF-8, which TOML asks for"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name here")
def test_a_pipe_is_no_file(tmp_path):
    os.mkfifo(tmp_path / "pipe.toml")
    with pytest.raises(OptionError, match="is no file"):
        read_options(tmp_path / "pipe.toml", {})


def test_the_sentence_tells_where_a_wrong_option_stands(tmp_path):
    file = given(tmp_path, 'join = "mitre"\n')
    with pytest.raises(OptionError) as error:
        read_options(file, {"pieces": "12"})
    assert str(error.value) == f"{file}: join: 'mitre' is none of miter, round: did you mean miter?"
    with pytest.raises(OptionError) as error:
        read_options(file, {"join": "rond"})
    assert str(error.value) == "--join: 'rond' is none of miter, round: did you mean round?"
    with pytest.raises(OptionError, match=f"^{file}: clearence: .*did you mean clearance"):
        read_options(given(tmp_path, "clearence = 0.1\n"), {})
    with pytest.raises(OptionError, match=r"^--method: 'lcsm' is none of .*did you mean lscm"):
        read_options(None, {"charts": "lcsm"}, spelt={"charts": "method"})
