"""A file whose bytes are of another kind than its name is told by its bytes."""

import io
import zipfile

import numpy as np
import pytest
import trimesh
from PIL import Image

from meshjig.errors import InputError
from meshjig.scan.load import load
from tests.meshes import sphere

MESH = trimesh.Trimesh(*sphere(100), process=False)


def picture(kind):
    file = io.BytesIO()
    Image.new("RGB", (9, 9)).save(file, kind)
    return file.getvalue()


def package(*names):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name in names:
            archive.writestr(name, "x" * 50)
    return file.getvalue()


def exported(kind):
    data = MESH.export(file_type=kind)
    return data.encode() if isinstance(data, str) else data


PAGE = b"\n<!DOCTYPE html>\n<html><body>Not found</body></html>"
POINTER = b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12\n"
COLLADA = b'<?xml version="1.0"?>\n<COLLADA version="1.4.1"></COLLADA>'
GLTF = b'{"asset": {"version": "2.0"}, "meshes": []}'
OTHERS = [
    (picture("PNG"), "a PNG picture: give the mesh"),
    (picture("JPEG"), "a JPEG picture"),
    (picture("WEBP"), "a WEBP picture"),
    (package("readme.txt"), "a ZIP archive: unpack it"),
    (b"\x1f\x8b\x08\0" + bytes(200), "a gzip archive"),
    (PAGE, "a web page: download"),
    (COLLADA, "a COLLADA model: export"),
    (POINTER, "git lfs pull"),
    (b"ISO-10303-21;\nHEADER;\n", "a STEP model"),
    (b"Kaydara FBX Binary  \0\x1a\0" + bytes(90), "an FBX model"),
]


@pytest.mark.parametrize("kind", ["stl", "obj", "ply", "off", "glb", "gltf", "3mf"])
def test_what_is_no_mesh_is_named(tmp_path, kind):
    for data, sentence in OTHERS:
        path = tmp_path / f"scan.{kind}"
        path.write_bytes(data)
        with pytest.raises(InputError, match=f"is no {kind.upper()} file: it holds .*{sentence}"):
            load(path)


@pytest.mark.parametrize("kind", ["stl", "obj", "ply", "off", "glb", "gltf", "3mf"])
def test_a_mesh_of_another_format_is_named(tmp_path, kind):
    path = tmp_path / f"scan.{kind}"
    data = {name: exported(name) for name in ("obj", "ply", "off", "glb")}
    data |= {"stl": exported("stl_ascii"), "3mf": package("3D/3dmodel.model"), "gltf": GLTF}
    for name, content in data.items():
        path.write_bytes(content)
        if name != kind:
            with pytest.raises(InputError, match=f"those of {name.upper()}: rename it to scan.{name}"):
                load(path)


def test_a_binary_stl_is_told_by_its_size(tmp_path):
    (tmp_path / "scan.obj").write_bytes(exported("stl"))
    with pytest.raises(InputError, match=r"those of STL: rename it to scan\.stl"):
        load(tmp_path / "scan.obj")


def test_a_file_without_a_known_ending_is_told_by_its_bytes(tmp_path):
    for name, sentence in [("scan", "rename it to scan.ply"), ("scan.dat", "rename it to scan.ply")]:
        (tmp_path / name).write_bytes(exported("ply"))
        with pytest.raises(InputError, match=sentence):
            load(tmp_path / name)


def test_the_head_of_a_binary_stl_may_say_anything(tmp_path):
    path = tmp_path / "scan.stl"
    for words in (b"\x89PNG\r\n\x1a\n", b"PK\x03\x04", b"solid facet", b"OFF ", b"ply\n", b"<html>"):
        path.write_bytes(words.ljust(80, b" ") + exported("stl")[80:])
        assert len(load(path).F) == len(MESH.faces)


def test_what_is_right_is_read(tmp_path):
    for kind in ("obj", "ply", "off", "glb", "stl", "stl_ascii"):
        path = tmp_path / f"scan.{kind[:3]}"
        path.write_bytes(exported(kind))
        assert np.ptp(load(path).V, axis=0) == pytest.approx(MESH.extents, rel=1e-5)
