"""Triangles in every form that glTF has for them."""

import importlib.util

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.gltf import primitives, read_gltf
from tests.meshes import sphere
from tests.scan.files.gltf.build import TETRAHEDRON, Build

DRACO = "KHR_draco_mesh_compression"


def read(build, tmp_path):
    return read_gltf(build.glb(tmp_path / "a.glb"), PictureReader())


@pytest.mark.parametrize(
    ("mode", "corners", "faces"),
    [
        (4, [0, 2, 1, 0, 1, 3], [[0, 2, 1], [0, 1, 3]]),
        (5, [0, 1, 2, 3], [[0, 1, 2], [2, 1, 3]]),
        (5, [0, 1, 2, 2, 3, 0], [[0, 1, 2], [0, 3, 2]]),
        (6, [0, 1, 2, 3], [[0, 1, 2], [0, 2, 3]]),
    ],
)
def test_lists_strips_and_fans(tmp_path, mode, corners, faces):
    build = Build()
    build.scene(build.part(F=corners, more={"mode": mode}))
    found = read(build, tmp_path)[0].faces
    turned = [np.roll(face, -int(np.argmin(face))).tolist() for face in found]
    assert turned == [np.roll(face, -int(np.argmin(face))).tolist() for face in faces]


def test_corners_without_numbers_are_taken_in_their_order(tmp_path):
    build = Build()
    part = build.part(V=TETRAHEDRON[[0, 2, 1]])
    del part["indices"]
    source, _ = read(build.scene(part), tmp_path)
    assert source.faces.tolist() == [[0, 1, 2]]


def test_points_and_lines_are_left_out_and_named(tmp_path):
    build = Build()
    build.scene(build.part(), build.part(F=[0, 1], more={"mode": 1}), build.part(F=[0], more={"mode": 0}))
    source, notes = read(build, tmp_path)
    assert len(source.faces) == 4
    assert notes == ["left out: 2 parts of points or lines"]


def test_each_part_may_be_quantised_in_its_own_way(tmp_path):
    build = Build(extensionsRequired=["KHR_mesh_quantization"])
    V = np.rint(32767 * TETRAHEDRON).astype("i2")
    padded = np.hstack([V, np.zeros((4, 1), "i2")])
    part = build.part()
    view = build.view(padded.tobytes(), byteStride=8)
    part["attributes"]["POSITION"] = build.accessor(
        {"bufferView": view, "componentType": 5122, "normalized": True, "count": 4, "type": "VEC3"}
    )
    source, _ = read(build.scene(part, build.part(V=TETRAHEDRON + 2)), tmp_path)
    np.testing.assert_allclose(source.vertices, np.vstack([TETRAHEDRON, TETRAHEDRON + 2]), atol=1e-6)


def test_faces_that_name_vertices_of_other_parts_are_refused(tmp_path):
    build = Build()
    build.scene(build.part(F=[[0, 1, 4]]), build.part())
    with pytest.raises(InputError, match="a part of 4 vertices that names others in 1 of its 1 faces"):
        read(build, tmp_path)


def packed(data, **attributes):
    build = Build(extensionsUsed=[DRACO], extensionsRequired=[DRACO])
    part = {
        "attributes": {"POSITION": build.accessor({"componentType": 5126, "count": 4, "type": "VEC3"})},
        "indices": build.accessor({"componentType": 5125, "count": 12, "type": "SCALAR"}),
        "extensions": {DRACO: {"bufferView": build.view(data), "attributes": attributes}},
    }
    return build.scene(part)


@pytest.mark.parametrize("installed", [True, False])
def test_draco_that_cannot_be_read_is_named(tmp_path, monkeypatch, installed):
    if installed and importlib.util.find_spec("DracoPy") is None:
        pytest.skip("no DracoPy here")
    monkeypatch.setattr(primitives, "_can_unpack", lambda: installed)
    with pytest.raises(InputError, match="Draco") as caught:
        read(packed(b"DRACO" + bytes(200), POSITION=0), tmp_path)
    assert "without Draco" in caught.value.hint


def test_draco_is_read(tmp_path):
    draco = pytest.importorskip("DracoPy")
    V, F = sphere(300)
    rgb = np.rint(255 * (V - V.min(0)) / np.ptp(V, axis=0)).astype(np.uint8)
    data = draco.encode(V.astype("f4"), F.astype("u4"), quantization_bits=16, colors=rgb)
    ids = {attribute["attribute_type"]: attribute["unique_id"] for attribute in draco.decode(data).attributes}
    build = packed(data, POSITION=ids[0], COLOR_0=ids[2])
    colour = build.accessor({"componentType": 5121, "normalized": True, "count": len(V), "type": "VEC3"})
    build.header["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colour
    build.header["asset"]["generator"] = "trimesh"  # colours as a screen shows them
    source, _ = read(build, tmp_path)
    assert len(source.faces) == len(F)
    np.testing.assert_allclose(np.ptp(source.vertices, axis=0), np.ptp(V, axis=0), rtol=1e-3)
    here = source.vertices[source.faces]
    np.testing.assert_allclose(source.look.rgb, 255 * (here - V.min(0)) / np.ptp(V, axis=0), atol=1)
