"""OFF files: heads, comments, and colours in all their kinds."""

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.scan.load import load

PLACES = ["0 0 0", "9 0 0", "9 9 0", "0 9 0"]
PLAIN = "OFF\n4 1 0\n" + "\n".join(PLACES) + "\n4 0 1 2 3\n"
SQUARE = [[0, 1, 2], [2, 3, 0]]


def read(folder, text):
    path = folder / "model.off"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return load(path)


def with_more(word, more, face="4 0 1 2 3"):
    rows = "\n".join(f"{place} {m}" for place, m in zip(PLACES, more, strict=True))
    return f"{word}\n4 1 0\n{rows}\n{face}\n"


@pytest.mark.parametrize(
    "text",
    [
        PLAIN,
        PLAIN.replace("OFF\n", "OFF "),
        PLAIN.replace("OFF\n", ""),
        PLAIN.replace("OFF\n", "# made by hand\n\noff # so\n# counts\n").replace("9 0 0\n", "9 0 0 # x\n\n"),
        PLAIN.replace("\n", "\r\n"),
        PLAIN.replace("\n", "\r"),
        b"\xef\xbb\xbf" + PLAIN.encode(),
        PLAIN.encode("utf-16"),
        with_more("NOFF", ["0 0 1"] * 4),
        with_more("STOFF", ["0 0", "1 0", "1 1", "0 1"]),
        PLAIN.replace("OFF", "4OFF").replace("0\n", "0 1\n").replace("4 1 0 1", "4 1 0"),
    ],
)
def test_heads_and_comments_in_every_spelling(tmp_path, text):
    found = read(tmp_path, text)
    assert found.F.tolist() == SQUARE
    assert found.V.tolist() == [[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0]]
    assert found.source.look.rgb is None


def test_homogeneous_places_are_divided(tmp_path):
    text = with_more("4OFF", ["1", "2", "1", "1"])
    assert read(tmp_path, text).V.tolist() == [[0, 0, 0], [4.5, 0, 0], [9, 9, 0], [0, 9, 0]]


BESIDE = [("COFF", "", ""), ("OFF", "", ""), ("CNOFF", "0 0 1 ", ""), ("STCOFF", "", " 0.5 1")]


@pytest.mark.parametrize(("word", "before", "after"), BESIDE)
@pytest.mark.parametrize("alpha", ["", " 255"])
def test_colours_of_vertices(tmp_path, word, before, after, alpha):
    colours = ["255 0 0", "0 255 0", "0 0 255", "9 9 9"]
    found = read(tmp_path, with_more(word, [before + c + alpha + after for c in colours]))
    wanted = np.array([c.split() for c in colours], int)
    assert found.source.look.rgb.tolist() == wanted[found.F].tolist()
    shares = [" ".join(f"{int(x) / 255:.5f}" for x in c.split()) for c in colours]
    alpha = alpha.replace("255", "1.0")
    found = read(tmp_path, with_more(word, [before + c + alpha + after for c in shares]))
    assert found.source.look.rgb.tolist() == wanted[found.F].tolist()


@pytest.mark.parametrize("colour", ["255 128 0", "255 128 0 255", "1.0 0.502 0.0", "1.0 0.502 0.0 0.5"])
def test_colours_of_faces_come_before_those_of_vertices(tmp_path, colour):
    found = read(tmp_path, with_more("COFF", ["0 0 255 255"] * 4, f"4 0 1 2 3 {colour}"))
    assert found.source.look.rgb.tolist() == [[[255, 128, 0]] * 3] * 2


def test_numbers_of_colours_are_told(tmp_path):
    assert "colours of a table" in read(tmp_path, PLAIN.replace("3\n", "3 7\n")).notes[0]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (PLAIN.replace("4 0 1 2 3\n", ""), "announces 5 vertices and faces and holds 4"),
        (PLAIN.replace("4 0 1 2 3", "4 0 1"), "its last face, '4 0 1', is not whole"),
        (PLAIN.replace("4 0 1 2 3", "4 0 1 2 7"), "1 of its 1 faces can't be read"),
        (PLAIN.replace("OFF", "OFF BINARY"), "binary OFF"),
        (PLAIN.replace("OFF", "nOFF"), "other than three dimensions"),
        (PLAIN.replace("4 1 0", "some"), "does not say how many"),
        ("OFF\n0 0 0\n", "holds no faces"),
    ],
)
def test_what_is_wrong_has_its_sentence(tmp_path, text, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, text)
