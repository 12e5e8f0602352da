"""Text in any coding gives the same lines and numbers."""

import numpy as np
import pytest

from meshjig.scan.files.words import NONE, Lines, plain, table, unmarked

TEXT = "v 1 2.5 -3e2\n# a comment\n\n  f 1/2/3  4//5 6 # last\nname größe 1\nv\t7 8 9\n"
CODINGS = {
    "plain": TEXT.encode(),
    "marked": b"\xef\xbb\xbf" * 2 + TEXT.encode(),
    "windows": TEXT.replace("\n", "\r\n").encode(),
    "old macs": TEXT.replace("\n", "\r").encode(),
    "utf-16": TEXT.encode("utf-16"),
    "utf-16 big": b"\xfe\xff" + TEXT.encode("utf-16-be"),
    "utf-16 unmarked": TEXT.encode("utf-16-le"),
    "utf-16 big unmarked": TEXT.encode("utf-16-be"),
    "without an end": TEXT.rstrip("\n").encode(),
}


@pytest.mark.parametrize("data", CODINGS.values(), ids=CODINGS.keys())
def test_text_is_the_same_in_every_coding(data):
    assert plain(data).decode() == TEXT


def test_lines_are_told_by_their_first_word():
    lines = Lines(plain(TEXT.encode()))
    assert len(lines) == 6
    assert lines.sizes.tolist() == [4, 3, 0, 6, 3, 4]
    assert lines.starting(b"v").tolist() == [0, 5]
    assert lines.starting(b"f", b"v").tolist() == [0, 3, 5]
    assert lines.starting(b"na").tolist() == []
    assert lines.rest(4) == "größe 1"
    assert lines.rest(2) == ""


def test_numbers_of_some_lines():
    lines = Lines(plain(TEXT.encode()))
    rows = lines.only(lines.starting(b"v"), without=1)
    assert rows.floats().tolist() == [1, 2.5, -300, 7, 8, 9]
    faces = lines.only(lines.starting(b"f"), without=1)
    assert faces.sizes.tolist() == [3]
    assert faces.slashes().tolist() == [2, 2, 0]
    assert len(lines.filled()) == 4


def test_what_is_no_number_keeps_its_place():
    lines = Lines(b"1 x 1,5 0x2\n7 2.0 2.5 99999999999999999999\n")
    np.testing.assert_array_equal(lines.floats()[:4], [1, np.nan, 1.5, np.nan])
    assert lines.integers().tolist() == [1, NONE, NONE, NONE, 7, 2, NONE, NONE]
    assert Lines(b" \n\n").floats().tolist() == []


def test_a_table_of_lists():
    values = np.arange(6.0)
    assert table(values, np.array([3, 3]), 2).tolist() == [[0, 1], [3, 4]]
    np.testing.assert_array_equal(table(values, np.array([1, 3, 2]), 2), [[0, np.nan], [1, 2], [4, 5]])


def test_a_mark_is_taken_off():
    assert unmarked(b"\xef\xbb\xbfply") == b"ply"
    assert unmarked(b"ply\xef\xbb\xbf") == b"ply\xef\xbb\xbf"
