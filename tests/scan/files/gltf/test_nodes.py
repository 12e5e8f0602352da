"""Meshes stand where the scene places them, as often as it does."""

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.mesh.measure import mesh_volume
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.gltf import read_gltf
from tests.scan.files.gltf.build import Build

QUARTER = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]  # a turn about z


def read(build, tmp_path):
    return read_gltf(build.glb(tmp_path / "a.glb"), PictureReader())


def tetrahedron(*nodes, **more):
    build = Build()
    build.scene(build.part())
    build.header |= {"nodes": list(nodes), "scenes": [{"nodes": [0]}]} | more
    return build


def test_nodes_move_turn_and_scale_what_is_below_them(tmp_path):
    build = tetrahedron(
        {"children": [1], "translation": [10, 0, 0], "rotation": QUARTER},
        {"children": [2], "scale": [2, 3, 4]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1]},
    )
    source, notes = read(build, tmp_path)
    expected = [[10, 2, 0], [10, 4, 0], [7, 2, 0], [10, 2, 4]]
    np.testing.assert_allclose(source.vertices, expected, atol=1e-6)
    assert notes == []


def test_a_mesh_may_be_placed_many_times(tmp_path):
    build = tetrahedron({"children": [1, 2]}, {"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]})
    source, _ = read(build, tmp_path)
    assert len(source.faces) == 8
    np.testing.assert_allclose(source.vertices.max(axis=0), [6, 1, 1])


def test_instances_are_placed(tmp_path):
    build = tetrahedron({"mesh": 0, "translation": [0, 0, 1]}, extensionsRequired=["EXT_mesh_gpu_instancing"])
    attributes = {
        "TRANSLATION": build.array(np.array([[0, 0, 0], [3, 0, 0], [6, 0, 0]], "f4")),
        "SCALE": build.array(np.array([[1, 1, 1], [1, 1, 1], [2, 2, 2]], "f4")),
    }
    build.header["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    source, _ = read(build, tmp_path)
    assert len(source.faces) == 12
    np.testing.assert_allclose(
        [source.vertices.min(axis=0), source.vertices.max(axis=0)], [[0, 0, 1], [8, 2, 3]]
    )


def test_what_is_mirrored_is_turned_outside_in_again(tmp_path):
    build = tetrahedron({"mesh": 0, "scale": [-1, 1, 1]})
    colours = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]], "f4")
    build.header["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = build.array(colours)
    source, _ = read(build, tmp_path)
    assert mesh_volume(source.vertices, source.faces) == pytest.approx(1 / 6)
    np.testing.assert_array_equal(source.look.rgb, (255 * colours).astype(np.uint8)[source.faces])


@pytest.mark.parametrize("children", [[[1], [0]], [[1, 2], [2], []], [[0]]])
def test_nodes_within_themselves_are_refused(tmp_path, children):
    build = tetrahedron(*({"mesh": 0, "children": below} for below in children))
    with pytest.raises(InputError, match="in itself or in several others"):
        read(build, tmp_path)


def test_the_scene_that_is_shown_is_read_and_others_are_named(tmp_path):
    build = tetrahedron(
        {"mesh": 0}, {"mesh": 0}, {"mesh": 0}, scene=1, scenes=[{"nodes": [0, 2]}, {"nodes": [1]}]
    )
    source, [note] = read(build, tmp_path)
    assert len(source.faces) == 4
    assert "of 2 scenes" in note
    del build.header["scene"]
    assert len(read(build, tmp_path)[0].faces) == 12


def test_copies_beyond_measure_are_refused(tmp_path):
    build = tetrahedron({"mesh": 0})
    build.scene(build.part(F=np.tile([[0, 1, 2]], (3000, 1))))
    build.header["nodes"] = [{"children": list(range(1, 1001))}, *[{"mesh": 0}] * 1000]
    with pytest.raises(InputError, match="3000000 faces together"):
        read(build, tmp_path)


def test_meshes_that_are_not_shown_or_empty_are_named(tmp_path):
    build = tetrahedron({"mesh": 0})
    build.header["meshes"].append(build.header["meshes"][0])
    source, [note] = read(build, tmp_path)
    assert len(source.faces) == 4
    assert note == "left out: 1 mesh that the scene does not show"
    build.header["meshes"][1] = {"primitives": []}
    build.header["nodes"].append({"mesh": 1})
    build.header["scenes"] = [{"nodes": [0, 1]}]
    source, [note] = read(build, tmp_path)
    assert len(source.faces) == 4
    assert note == "left out: mesh 1, which has nothing in it"
