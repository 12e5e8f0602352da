"""Every format and all that it can carry: written, and read back to the right value."""

import numpy as np
import pytest

from meshjig.scan.load import load
from tests.scan.files import carried
from tests.scan.files.write_scenes import glb, gltf, three_mf
from tests.scan.files.write_text import obj, off, ply, stl

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
    ("GLB", glb, ["several bodies", "vertex colours", "face colours", "texture"]),
    ("glTF", gltf, ["several bodies", "vertex colours", "face colours", "texture"]),
    ("3MF", three_mf, ["several bodies", "vertex colours", "face colours", "texture"]),
]
SAYS = [
    ("OBJ", obj, None, None),
    ("STL", stl, None, None),
    ("PLY", ply("<"), None, None),
    ("OFF", off, None, None),
    ("GLB", glb, 1000, "y"),
    ("glTF", gltf, 1000, "y"),
    ("3MF", three_mf, 25.4, "z"),
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


BY_PYMESHLAB = [("stl", "face colours")]
BY_PYMESHLAB += [(kind, f"{of} colours") for kind in ("obj", "ply", "off") for of in ("vertex", "face")]


@pytest.mark.parametrize(("kind", "carries"), BY_PYMESHLAB)
def test_colours_as_a_library_writes_them(tmp_path, kind, carries):
    import pymeshlab

    of_faces = carries == "face colours"
    colours = (
        carried.colour_towards(carried.normals(carried.TRIANGLES))
        if of_faces
        else carried.colour_at(carried.V)
    )
    name = "f_color_matrix" if of_faces else "v_color_matrix"
    shown = {name: np.column_stack([colours / 255, np.ones(len(colours))])}
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(carried.V, carried.TRIANGLES, **shown))
    path = tmp_path / f"model.{kind}"
    saved = {"save_face_color": of_faces, "save_vertex_color": not of_faces} if kind != "stl" else {}
    meshes.save_current_mesh(str(path), **saved)
    read = load(path)
    carried.assert_polygons(read.source)
    SURFACE[carries](read.source)


@pytest.mark.parametrize(("name", "write", "unit", "up"), SAYS)
def test_a_format_says_its_unit_and_what_is_up(tmp_path, name, write, unit, up):
    source = load(write(tmp_path, "several bodies")).source
    assert (source.unit and source.unit.mm, source.up) == (unit, up)
