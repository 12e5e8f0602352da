"""Every format and all that it can carry: written, and read back to the right value."""

import pytest

from meshjig.scan.load import load
from tests.scan import carried
from tests.scan.write_text import obj, off, ply, stl

SURFACE = {
    "polygons": carried.assert_polygons,
    "several bodies": carried.assert_several_bodies,
    "vertex colours": carried.assert_vertex_colours,
    "face colours": carried.assert_face_colours,
    "texture": carried.assert_texture,
}
TABLE = [
    ("OBJ", obj, ["polygons", "several bodies", "vertex colours", "face colours", "texture"]),
    ("STL", stl, ["several bodies", "face colours"]),
    ("PLY text", ply(""), ["polygons", "several bodies", "vertex colours", "face colours", "texture"]),
    ("PLY little", ply("<"), ["polygons", "several bodies", "vertex colours", "face colours", "texture"]),
    ("PLY big", ply(">"), ["polygons", "several bodies", "vertex colours", "face colours", "texture"]),
    ("OFF", off, ["polygons", "several bodies", "vertex colours", "face colours"]),
]
SAYS = [
    ("OBJ", obj, None, None),
    ("STL", stl, None, None),
    ("PLY", ply("<"), None, None),
    ("OFF", off, None, None),
]


@pytest.mark.parametrize(
    ("write", "carries"),
    [
        pytest.param(write, carries, id=f"{name}: {carries}")
        for name, write, all_ in TABLE
        for carries in all_
    ],
)
def test_what_a_format_carries_arrives(tmp_path, write, carries):
    read = load(write(tmp_path, carries))
    SURFACE[carries](read.source)
    assert read.notes == []


@pytest.mark.parametrize(("name", "write", "unit", "up"), SAYS)
def test_a_format_says_its_unit_and_what_is_up(tmp_path, name, write, unit, up):
    source = load(write(tmp_path, "several bodies")).source
    assert (source.unit and source.unit.mm, source.up) == (unit, up)
