"""A file that announces more than it can hold is refused before anything is made for it."""

import json
import os
import struct
import zipfile

import pytest

from meshjig.errors import InputError
from meshjig.output.files.read_pieces import read_puzzle_files
from meshjig.output.report import read_report
from meshjig.scan.load import load

PLY = """ply
format {kind} 1.0
element vertex {n}
property float x
property float y
property float z
element face 7
property list uchar int vertex_indices
end_header
"""
CORNER = "0 0 0\n1 0 0\n0 1 0\n"
MODEL = """<?xml version="1.0"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>
<object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="9" y="0" z="0"/>
<vertex x="0" y="9" z="0"/><vertex x="0" y="0" z="9"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>
<triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/></triangles>
</mesh></object>{objects}</resources><build><item objectid="{last}"/></build></model>"""
TYPES = """<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>"""
RELATIONS = """<?xml version="1.0"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r"
Target="/3D/m.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>"""


def package(path, objects="", last=1, attachment=0):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", TYPES)
        archive.writestr("_rels/.rels", RELATIONS)
        archive.writestr("3D/m.model", MODEL.format(objects=objects, last=last))
        with archive.open("Metadata/zeros.bin", "w", force_zip64=True) as file:
            for _ in range(attachment):
                file.write(bytes(1_000_000))
    return path


def doubled(times):
    """Give objects, each made of two of the one before."""
    part = '<component objectid="{k}"/>'
    return "".join(
        f'<object id="{k + 1}" type="model"><components>{part.format(k=k) * 2}</components></object>'
        for k in range(1, times + 1)
    )


def gltf(count=3, **more):
    points = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    header = {
        "asset": {"version": "2.0"},
        "accessors": [{"componentType": 5126, "count": count, "type": "VEC3"} | more],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
    }
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 4)
    body = (
        struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(points), b"BIN\0") + points
    )
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        (
            "a.ply",
            PLY.format(kind="binary_little_endian", n=50_000_000).encode() + bytes(900),
            "50000000 elements",
        ),
        ("b.ply", (PLY.format(kind="ascii", n=50_000_000) + CORNER).encode(), "50000000 elements"),
        ("c.off", f"OFF\n50000000 90000000 0\n{CORNER}".encode(), "50000000 vertices"),
        ("d.glb", gltf(300_000_000), "300000000 entries"),
    ],
)
def test_a_head_that_announces_too_much_is_told(tmp_path, name, data, words):
    (tmp_path / name).write_bytes(data)
    for read in (load, lambda path: read_puzzle_files([path])) if name[2:] != "off" else (load,):
        with pytest.raises(InputError, match=words):
            read(tmp_path / name)


def test_what_is_packed_into_a_3mf_is_looked_at_before_it_is_unpacked(tmp_path):
    zeros = package(tmp_path / "zeros.3mf", attachment=200)
    for read in (load, lambda path: read_puzzle_files([path])):
        with pytest.raises(InputError, match=r"would unpack to 2\d+"):
            read(zeros)


def test_objects_placed_beyond_measure_are_counted_before_they_are_made(tmp_path):
    many = package(tmp_path / "many.3mf", doubled(30), 31)
    for read in (load, lambda path: read_puzzle_files([path])):
        with pytest.raises(InputError, match=r"faces together"):
            read(many)
    assert len(load(package(tmp_path / "few.3mf", doubled(5), 6)).F) == 4 * 2**5


def test_objects_nested_beyond_measure_are_told(tmp_path):
    part = '<object id="{}" type="model"><components><component objectid="{}"/></components></object>'
    chain = "".join(part.format(k + 1, k) for k in range(1, 3000))
    with pytest.raises(InputError, match="nests its objects 3000 deep"):
        load(package(tmp_path / "chain.3mf", chain, 3000))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name here")
@pytest.mark.parametrize("kind", ["obj", "gltf", "ply"])
def test_a_pipe_among_the_files_that_a_mesh_names_is_refused(tmp_path, kind):
    os.mkfifo(tmp_path / "pipe")
    path = tmp_path / f"model.{kind}"
    if kind == "obj":
        path.write_text("mtllib pipe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    elif kind == "ply":
        text = PLY.format(kind="ascii", n=3).replace(
            "element face 7", "property float s\nproperty float t\ncomment TextureFile pipe\nelement face 1"
        )
        path.write_text(text + CORNER.replace("\n", " 0 0\n") + "3 0 1 2\n")
    else:
        header = json.loads(gltf(bufferView=0)[20:].split(b"BIN")[0][:-4].decode("latin-1").rstrip("\0 "))
        header |= {
            "buffers": [{"uri": "pipe", "byteLength": 36}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
        }
        path.write_text(json.dumps(header))
    with pytest.raises(InputError, match="pipe, which is no regular file"):
        load(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name here")
def test_a_pipe_in_place_of_a_file_is_refused(tmp_path):
    os.mkfifo(tmp_path / "scan.stl")
    with pytest.raises(InputError, match="no regular file"):
        load(tmp_path / "scan.stl")
    os.mkfifo(tmp_path / "report.json")
    with pytest.raises(InputError, match="no regular file"):
        read_report(tmp_path / "report.json")
