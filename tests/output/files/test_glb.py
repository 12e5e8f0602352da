"""GLB has a named node a piece, in metres, with colours that are linear as the standard asks."""

import io
import json
import struct

import numpy as np
import pytest
import trimesh
from PIL import Image

from meshjig.mesh.measure import mesh_volume
from meshjig.output.files.glb import write_glb
from meshjig.output.files.read_parts import read_glb
from meshjig.output.pictures.colours import to_linear, to_srgb
from meshjig.output.piece import Piece
from meshjig.output.scan_picture import Picture
from meshjig.output.texture import Texture
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.gltf import read_gltf
from tests.meshes import sphere, torus

COLOURED = [
    Piece("piece_001", *sphere(300), (1.0, 0.2, 0.0)),
    Piece("piece_002", *torus(500), (0.0, 0.4, 1.0)),
]


def test_a_named_coloured_node_a_piece_in_metres(tmp_path):
    write_glb(tmp_path / "puzzle.glb", COLOURED)
    scene = trimesh.load_scene(tmp_path / "puzzle.glb", process=False)
    assert set(scene.graph.nodes_geometry) == {"piece_001", "piece_002"}
    for piece in COLOURED:
        transform, name = scene.graph[piece.name]
        mesh = scene.geometry[name]
        points = trimesh.transform_points(mesh.vertices, transform)
        np.testing.assert_allclose(1000 * points[mesh.faces], piece.V[piece.F], atol=1e-3)
        colour = mesh.visual.material.baseColorFactor[:3]
        np.testing.assert_allclose(colour, np.round(255 * to_linear(np.array(piece.colour))), atol=1)


def dressed(textured):
    V, F = sphere(300)
    here = (V[F] - V.min(0)) / np.ptp(V, axis=0)
    ramp = np.linspace(0, 255, 256).astype(np.uint8)
    pixels = np.dstack(
        [np.tile(ramp, (256, 1)), np.tile(ramp[::-1, None], (1, 256)), np.zeros((256, 256), "u1")]
    )
    texture = Texture(np.ones(len(F), bool), here * (1, 1, 0))
    if textured:
        texture = Texture(texture.outer, texture.rgb, here[..., :2], Picture(pixels))
    return Piece("piece_001", V, F, (0.5, 0.5, 0.5), texture=texture)


def header_of(path):
    data = path.read_bytes()
    size, whole = struct.unpack_from("<8xI4xI", data, 0)[0], len(data)
    (length,) = struct.unpack_from("<I", data, 12)
    assert size == whole
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def test_colours_of_corners_have_16_bits_and_are_linear(tmp_path):
    piece = dressed(False)
    write_glb(tmp_path / "a.glb", [piece])
    header, data = header_of(tmp_path / "a.glb")
    [primitive] = header["meshes"][0]["primitives"]
    assert header["materials"][primitive["material"]]["pbrMetallicRoughness"]["metallicFactor"] == 0
    arrays = {}
    for name in ("COLOR_0", "POSITION"):
        accessor = header["accessors"][primitive["attributes"][name]]
        view = header["bufferViews"][accessor["bufferView"]]
        kind = {5123: "<u2", 5126: "<f4"}[accessor["componentType"]]
        arrays[name] = np.frombuffer(data[view["byteOffset"] :][: view["byteLength"]], kind)
    rgb = to_srgb(arrays["COLOR_0"].reshape(-1, 4)[:, :3] / 65535)
    V = 1000 * arrays["POSITION"].reshape(-1, 3)
    expected = (V - piece.V.min(0)) / np.ptp(piece.V, axis=0) * (1, 1, 0)
    np.testing.assert_allclose(rgb, expected, atol=1e-3)


def test_what_corners_show_is_read_back(tmp_path):
    for textured in (False, True):
        piece = dressed(textured)
        write_glb(tmp_path / "a.glb", [piece])
        source, notes = read_gltf(tmp_path / "a.glb", PictureReader())
        assert notes == []
        np.testing.assert_allclose(1000 * source.vertices[source.faces], piece.V[piece.F], atol=1e-3)
        if textured:
            np.testing.assert_allclose(source.look.uv, piece.texture.uv, atol=1e-6)
            np.testing.assert_array_equal(source.look.picture, piece.texture.picture.pixels)
        else:
            np.testing.assert_allclose(source.look.rgb, 255 * piece.texture.rgb, atol=0.6)


def test_a_picture_that_pieces_share_is_written_once(tmp_path):
    piece = dressed(True)
    write_glb(tmp_path / "a.glb", [piece, piece])
    header, data = header_of(tmp_path / "a.glb")
    [image] = header["images"]
    view = header["bufferViews"][image["bufferView"]]
    picture = Image.open(io.BytesIO(data[view["byteOffset"] :][: view["byteLength"]]))
    np.testing.assert_array_equal(np.asarray(picture), piece.texture.picture.pixels)
    assert len(header["meshes"]) == 2


@pytest.mark.parametrize(
    ("up", "turned"),
    [
        ([0, 1, 0], [10, 20, 30]),
        ([0.1, 0.2, 0.9], [10, 30, -20]),
        ([1, 0, 0], [-20, 10, 30]),
        ([0, -1, 0], [-10, -20, 30]),
    ],
)
def test_y_is_upward_whatever_is_up_and_pieces_are_read_back_as_they_were(tmp_path, up, turned):
    write_glb(tmp_path / "puzzle.glb", COLOURED, np.array(up, float))
    scene = trimesh.load_scene(tmp_path / "puzzle.glb", process=False)
    for piece, (name, V, F) in zip(COLOURED, read_glb(tmp_path / "puzzle.glb"), strict=True):
        np.testing.assert_allclose(V[F].mean(axis=(0, 1)), piece.V[piece.F].mean(axis=(0, 1)), atol=1e-3)
        assert mesh_volume(V, F) == pytest.approx(mesh_volume(piece.V, piece.F), rel=1e-4)
        transform, _ = scene.graph[name]
        np.testing.assert_allclose(transform[:3, :3] @ [10, 20, 30], turned, atol=1e-9)
        assert np.linalg.det(transform[:3, :3]) == pytest.approx(1)


def test_files_of_other_makers_are_read_as_their_scene_puts_them(tmp_path):
    scene = trimesh.Scene()
    half = np.diag([0.001, -0.001, -0.001, 1.0])
    scene.add_geometry(trimesh.creation.box((10, 20, 30)), node_name="a", transform=half)
    (tmp_path / "a.glb").write_bytes(scene.export(file_type="glb"))
    ((name, V, _),) = read_glb(tmp_path / "a.glb")
    assert name == "a"
    np.testing.assert_allclose(np.ptp(V, axis=0), [10, 20, 30], atol=1e-3)
