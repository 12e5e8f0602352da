"""Buffers and pictures are found wherever they are, and what is missing is named."""

import io

import numpy as np
import pytest
from PIL import Image

from meshjig.errors import InputError
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.gltf import read_gltf
from tests.scan.files.gltf.build import Build

UV = np.array([[0.1, 0.1], [0.4, 0.1], [0.1, 0.9], [0.6, 0.3]], "f4")


def read(path):
    return read_gltf(path, PictureReader())


def plain():
    build = Build()
    return build.scene(build.part())


def test_a_buffer_may_be_inside_the_text(tmp_path):
    assert len(read(plain().gltf(tmp_path / "a.gltf"))[0].faces) == 4


@pytest.mark.parametrize(
    ("uri", "name"),
    [
        ("a%20%C3%A4.bin", "a ä.bin"),
        ("a b.bin", "a b.bin"),
        ("50%25.bin", "50%.bin"),
        ("100%.bin", "100%.bin"),
    ],
)
def test_names_of_buffers_may_be_percent_encoded(tmp_path, uri, name):
    build = plain()
    (tmp_path / name).write_bytes(build.data)
    assert len(read(build.gltf(tmp_path / "a.gltf", uri))[0].faces) == 4


def test_a_missing_buffer_is_named(tmp_path):
    with pytest.raises(InputError, match=r"needs scene\.bin, which is not beside it"):
        read(plain().gltf(tmp_path / "a.gltf", "scene.bin"))


def test_a_missing_picture_is_named_and_the_mesh_read(tmp_path):
    build = Build(images=[{"uri": "skin.png"}], textures=[{"source": 0}])
    shown = build.material(baseColorTexture={"index": 0})
    build.scene(build.part(more={"material": shown}, TEXCOORD_0=build.array(UV)))
    source, notes = read(build.glb(tmp_path / "a.glb"))
    assert len(source.faces) == 4
    assert notes == ["the picture skin.png is missing: it is left out"]
    assert source.look.picture is None


def test_a_damaged_picture_is_named_and_the_mesh_read(tmp_path):
    build = Build()
    shown = build.texture(np.random.default_rng(0).integers(0, 255, (64, 64, 3), np.uint8))
    build.data = build.data[:200] + b"xxxx" + build.data[204:]
    build.scene(build.part(more={"material": shown}, TEXCOORD_0=build.array(UV)))
    source, [note] = read(build.glb(tmp_path / "a.glb"))
    assert len(source.faces) == 4
    assert note == "the picture number 0 is damaged: it is left out"


def test_a_picture_beside_the_file_is_found(tmp_path):
    buffer = io.BytesIO()
    Image.new("RGB", (8, 8), (10, 200, 30)).save(buffer, "PNG")
    (tmp_path / "my skin.png").write_bytes(buffer.getvalue())
    build = Build(images=[{"uri": "my%20skin.png"}], textures=[{"source": 0}])
    shown = build.material(baseColorTexture={"index": 0})
    build.scene(build.part(more={"material": shown}, TEXCOORD_0=build.array(UV)))
    source, notes = read(build.gltf(tmp_path / "a.gltf"))
    assert (source.look.picture == (10, 200, 30)).all()
    assert notes == []


@pytest.mark.parametrize(
    "name", ["EXT_meshopt_compression", "KHR_texture_basisu", "VENDOR_own_shapes", "KHR_node_visibility"]
)
def test_extensions_that_are_required_and_unknown_are_named(tmp_path, name):
    build = plain()
    build.header["extensionsRequired"] = [name]
    with pytest.raises(InputError, match=name) as caught:
        read(build.glb(tmp_path / "a.glb"))
    assert caught.value.hint.startswith("export it with")


def test_extensions_that_are_only_used_are_no_hindrance(tmp_path):
    build = plain()
    build.header["extensionsUsed"] = ["VENDOR_own_shapes", "KHR_materials_clearcoat"]
    assert len(read(build.glb(tmp_path / "a.glb"))[0].faces) == 4


def test_the_first_version_is_refused_by_name(tmp_path):
    build = plain()
    build.header["asset"]["version"] = "1.0"
    with pytest.raises(InputError, match=r"glTF of version 1\.0"):
        read(build.gltf(tmp_path / "a.gltf"))


@pytest.mark.parametrize(
    "change",
    [
        lambda h: h["accessors"][0].update(componentType=5555),
        lambda h: h["accessors"][0].update(type="VEC9"),
        lambda h: h["meshes"][0].update(primitives=None),
        lambda h: h["meshes"][0]["primitives"][0]["attributes"].pop("POSITION"),
        lambda h: h["bufferViews"][0].update(byteLength=10**9),
        lambda h: h["nodes"][0].update(mesh=7),
        lambda h: h["nodes"][0].update(matrix=[1, 2, 3]),
        lambda h: h.update(nodes="none"),
        lambda h: h["nodes"][0].update(children=[99]),
    ],
)
def test_what_is_damaged_ends_in_one_sentence(tmp_path, change):
    build = plain()
    change(build.header)
    with pytest.raises(InputError, match=r"a\.glb can't be read as glTF"):
        read(build.glb(tmp_path / "a.glb"))
