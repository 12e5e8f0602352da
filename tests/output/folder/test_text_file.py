"""A drawing is written whole, over its own earlier version only."""

import os

import pytest

from meshjig.errors import OutputError
from meshjig.output.folder.text_file import write_svg_file


def test_its_own_earlier_version_is_replaced(tmp_path):
    for text in ("<svg/>\n", "<svg>second</svg>\n"):
        write_svg_file(tmp_path / "a.svg", text)
        assert (tmp_path / "a.svg").read_text().startswith(text)
    assert [path.name for path in tmp_path.iterdir()] == ["a.svg"]


@pytest.mark.parametrize("changed", [True, False])
def test_somebody_elses_file_is_left_alone(tmp_path, changed):
    path = tmp_path / "a.svg"
    if changed:
        write_svg_file(path, "<svg/>\n")
    path.write_text(path.read_text().replace("svg", "SVG") if changed else "<svg>mine</svg>\n")
    was = path.read_text()
    with pytest.raises(OutputError, match=r"not written by meshjig, or was changed.*--svg"):
        write_svg_file(path, "<svg/>\n")
    assert path.read_text() == was
    assert [path.name for path in tmp_path.iterdir()] == ["a.svg"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name here")
def test_a_pipe_is_left_alone(tmp_path):
    os.mkfifo(tmp_path / "a.svg")
    with pytest.raises(OutputError, match="not written by meshjig"):
        write_svg_file(tmp_path / "a.svg", "<svg/>\n")
    assert (tmp_path / "a.svg").is_fifo()
