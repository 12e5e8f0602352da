"""Models that move are taken in the pose in which they are saved."""

import numpy as np

from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.gltf import read_gltf
from tests.scan.files.gltf.build import TETRAHEDRON, Build

MOVES = np.array([[0, 0, 0], [1, 0, 0], [0, 0, 0], [0, 0, 2]], "f4")


def read(build, tmp_path):
    return read_gltf(build.glb(tmp_path / "a.glb"), PictureReader())


def test_morph_targets_have_the_weights_of_the_file(tmp_path):
    build = Build(animations=[{}])
    build.scene(build.part(more={"targets": [{"POSITION": build.array(MOVES)}]}))
    build.header["meshes"][0]["weights"] = [0.5]
    source, [note] = read(build, tmp_path)
    np.testing.assert_allclose(source.vertices, TETRAHEDRON + MOVES / 2)
    assert "pose" in note
    build.header["nodes"][0]["weights"] = [0]
    np.testing.assert_allclose(read(build, tmp_path)[0].vertices, TETRAHEDRON)


def test_a_skin_follows_its_joints_and_not_its_node(tmp_path):
    build = Build()
    joints = build.array(np.array([[0, 1, 0, 0]] * 4, "u1"))
    weights = build.array(np.array([[1, 0, 0, 0]] * 2 + [[0, 1, 0, 0], [0.5, 0.5, 0, 0]], "f4"))
    build.scene(build.part(JOINTS_0=joints, WEIGHTS_0=weights))
    bind = np.tile(np.eye(4, dtype="f4"), (2, 1, 1))
    bind[1, 3, 0] = -5  # column by column: moves by -5 along x
    build.header["skins"] = [{"joints": [1, 2], "inverseBindMatrices": build.array(bind.reshape(2, 16))}]
    build.header["nodes"] = [
        {"mesh": 0, "skin": 0, "translation": [100, 0, 0]},
        {"children": [2], "scale": [2, 2, 2]},
        {"translation": [5, 0, 3]},
    ]
    build.header["scenes"] = [{"nodes": [0, 1]}]
    source, _ = read(build, tmp_path)
    expected = 2 * TETRAHEDRON + [[0, 0, 0], [0, 0, 0], [0, 0, 6], [0, 0, 3]]
    np.testing.assert_allclose(source.vertices, expected, atol=1e-6)
