"""STL files: text or bytes, whatever their first words and their counts say."""

import struct

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.scan.load import load
from tests.meshes import sphere

BALL = sphere(300)
CORNERS = BALL.V.astype(np.float32)[BALL.F]
COUNT = len(CORNERS)


def binary(count=COUNT, head=b"", more=None):
    more = np.zeros(COUNT, int) if more is None else more
    rows = b"".join(
        struct.pack("<12fH", 0, 0, 0, *c.ravel(), int(m)) for c, m in zip(CORNERS, more, strict=True)
    )
    return head.ljust(80, b"\0") + struct.pack("<I", count) + rows


def text(corners=CORNERS, name="ball"):
    facets = "".join(
        "facet normal 0 0 1\nouter loop\n" + "".join("vertex {} {} {}\n".format(*v) for v in c)
        + "endloop\nendfacet\n" for c in corners
    )  # fmt: skip
    return f"solid {name}\n{facets}endsolid {name}\n"


def read(folder, data):
    path = folder / "model.stl"
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return load(path)


@pytest.mark.parametrize("count", [2**32 - 1, 0, 3])
def test_a_count_that_was_not_filled_in_gives_way_to_the_size(tmp_path, count):
    found = read(tmp_path, binary(count))
    assert np.array_equal(found.V[found.F], CORNERS)
    assert f"by its size it has {COUNT}" in found.notes[0]


def test_what_follows_the_triangles_is_told(tmp_path):
    found = read(tmp_path, binary() + b"made by hand")
    assert len(found.F) == COUNT
    assert read(tmp_path, binary(head=b"solid, but of bytes")).notes == []


@pytest.mark.parametrize("cut", [1, 50, 5000])
def test_a_cut_off_file_says_so(tmp_path, cut):
    with pytest.raises(InputError, match=f"announces {COUNT} triangles and holds"):
        read(tmp_path, binary()[:-cut])


@pytest.mark.parametrize(
    "change",
    [
        lambda t: b"\xef\xbb\xbf" + t.encode(),
        lambda t: t.encode("utf-16"),
        lambda t: t.replace("\n", "\r\n"),
        lambda t: t.replace("\n", "\r"),
        lambda t: t.upper(),
        lambda t: t.replace("facet normal 0 0 1", "  facet normal W-0.1 nan", 1),
        lambda t: t.replace("endfacet", "endfacte", 1),
        lambda t: t.replace("endloop\nendfacet\n", "\n", 1),
        lambda t: "\n\n" + t.replace("vertex", "\tvertex "),
    ],
)
def test_text_in_every_coding_with_what_is_not_needed_damaged(tmp_path, change):
    found = read(tmp_path, change(text()))
    np.testing.assert_allclose(found.V[found.F], CORNERS)
    assert found.notes == []


def test_several_solids_and_facets_of_four_corners(tmp_path):
    square = text([[(0, 0, 50), (9, 0, 50), (9, 9, 50), (0, 9, 50)]], "top")
    assert len(read(tmp_path, text() + square).F) == COUNT + 2


def test_damaged_facets_are_counted(tmp_path):
    found = read(tmp_path, text().replace("vertex ", "vertex x", 1))
    assert len(found.F) == COUNT - 1
    assert f"1 of {COUNT} faces are left out" in found.notes[0]
    with pytest.raises(InputError, match=r"100 of its \d+ faces can't be read"):
        read(tmp_path, text().replace("vertex ", "vertex x", 300))


def test_colours_in_the_spare_bytes(tmp_path):
    five = np.array([31, 10, 0])
    shown = np.rint(five * 255 / 31).astype(int).tolist()
    viscam = 1 << 15 | five[0] << 10 | five[1] << 5 | five[2]
    more = np.where(np.arange(COUNT) % 2, viscam, 0)
    rgb = read(tmp_path, binary(more=more)).source.look.rgb
    assert rgb[:2].tolist() == [[[255] * 3] * 3, [shown] * 3]
    magics = five[2] << 10 | five[1] << 5 | five[0]
    more = np.where(np.arange(COUNT) % 2, magics, 1 << 15)
    rgb = read(tmp_path, binary(head=b"COLOR=\x09\x08\x07\xff,MATERIAL=", more=more)).source.look.rgb
    assert rgb[:2].tolist() == [[[9, 8, 7]] * 3, [shown] * 3]


def test_spare_bytes_that_are_no_colours_are_none(tmp_path):
    rng = np.random.default_rng(0)
    for more in (rng.integers(0, 2**16, COUNT), rng.integers(0, 2**15, COUNT)):
        assert read(tmp_path, binary(more=more)).source.look.rgb is None
