"""PLY files: tables in text and bytes, with properties of every name."""

import struct

import numpy as np
import pytest
from PIL import Image

from meshjig.errors import InputError
from meshjig.scan.load import load

PLACES = [(0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0), (4, 4, 9)]
RGB = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0), (0, 255, 255)]
MIXED = [[0, 1, 2, 3], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]  # a pyramid on a square


def head(kind, vertex="", faces=5, face="property list uchar int vertex_indices\n", count=5):
    xyz = "property float x\nproperty float y\nproperty float z\n"
    elements = f"element vertex {count}\n{xyz}{vertex}element face {faces}\n{face}"
    return f"ply\nformat {kind} 1.0\n{elements}end_header\n"


def text_rows(rows):
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


def read(folder, *parts):
    path = folder / "model.ply"
    path.write_bytes(b"".join(part if isinstance(part, bytes) else part.encode() for part in parts))
    return load(path)


def body(order):
    data = b"".join(struct.pack(order + "3f", *place) for place in PLACES)
    return data + b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in MIXED)


@pytest.mark.parametrize(("kind", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
def test_polygons_of_different_sizes_in_bytes(tmp_path, kind, order):
    found = read(tmp_path, head(kind), body(order))
    assert found.V.tolist() == [list(map(float, place)) for place in PLACES]
    assert found.F.tolist() == [[0, 1, 2], [2, 3, 0], *MIXED[1:]]
    for cut in (1, 13, 30, 80):
        with pytest.raises(InputError, match="cut off"):
            read(tmp_path, head(kind), body(order)[:-cut])


def test_properties_around_the_list_are_stepped_over(tmp_path):
    face = "property double area\nproperty list ushort short more\nproperty list uchar uint vertex_index\n"
    rows = b"".join(
        struct.pack(f"<dH{k}hB{len(f)}Ih", 1.5, k, *range(k), len(f), *f, 7) for k, f in enumerate(MIXED)
    )
    data = b"".join(struct.pack("<3f", *place) for place in PLACES)
    found = read(tmp_path, head("binary_little_endian", face=face + "property short end\n"), data, rows)
    assert len(found.F) == 6


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_heads_with_other_line_ends(tmp_path, end, mark):
    found = read(tmp_path, mark, head("binary_little_endian").replace("\n", end), body("<"))
    assert len(found.F) == 6
    text = head("ascii") + text_rows([*PLACES, *([len(f), *f] for f in MIXED)])
    assert len(read(tmp_path, mark, text.replace("\n", end)).F) == 6
    assert len(read(tmp_path, text.replace("\n", end).encode("utf-16")).F) == 6


@pytest.mark.parametrize("names", ["red green blue", "diffuse_red diffuse_green diffuse_blue", "r g b"])
@pytest.mark.parametrize("kind", ["uchar", "float", "ushort"])
def test_colours_of_vertices_by_any_name_and_type(tmp_path, names, kind):
    scale = {"uchar": 1, "float": 1 / 255, "ushort": 257}[kind]
    vertex = "".join(f"property {kind} {name}\n" for name in names.split())
    rows = [[*place, *np.array(rgb) * scale] for place, rgb in zip(PLACES, RGB, strict=True)]
    found = read(tmp_path, head("ascii", vertex), text_rows([*rows, *([len(f), *f] for f in MIXED)]))
    assert found.source.look.rgb.tolist() == np.array(RGB)[found.F].tolist()


def test_bytes_of_0_and_1_are_dark(tmp_path):
    rows = [[*place, 1, 1, 0] for place in PLACES]
    vertex = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
    found = read(tmp_path, head("ascii", vertex), text_rows([*rows, *([len(f), *f] for f in MIXED)]))
    assert found.source.look.describe() == "one colour: #010100"


@pytest.mark.parametrize("names", ["s t", "u v", "texture_u texture_v"])
def test_places_in_a_picture_by_vertices(tmp_path, names):
    Image.new("RGB", (8, 4), (9, 8, 7)).save(tmp_path / "a picture.png")
    vertex = "".join(f"property float {name}\n" for name in names.split())
    vertex += "comment TextureFile a picture.png\n"
    rows = [[*place, place[0] / 9, place[1] / 9] for place in PLACES]
    found = read(tmp_path, head("ascii", vertex), text_rows([*rows, *([len(f), *f] for f in MIXED)]))
    assert found.source.look.uv.tolist() == (found.V[found.F][..., :2] / 9).tolist()
    assert found.source.look.picture.shape == (4, 8, 3)
    (tmp_path / "a picture.png").unlink()
    missing = load(tmp_path / "model.ply")
    assert missing.notes == ["the picture a picture.png is missing: it is left out"]


def test_a_picture_without_places_is_named(tmp_path):
    lines = head("ascii", "comment TextureFile a.png\n")
    found = read(tmp_path, lines, text_rows([*PLACES, *([len(f), *f] for f in MIXED)]))
    assert found.notes == ["the picture a.png is left out: no face has a place in it"]


def test_several_pictures_by_numbers_of_faces(tmp_path):
    for name, colour in (("a.png", (255, 0, 0)), ("b.png", (0, 0, 255))):
        Image.new("RGB", (8, 8), colour).save(tmp_path / name)
    face = (
        "property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n"
    )
    places = [0.1, 0.1, 0.9, 0.1, 0.5, 0.9]
    rows = [[3, *f, 6, *places, k] for k, f in enumerate(MIXED[1:3])] + [[3, 2, 3, 4, 0, -1]]
    pictures = "comment TextureFile a.png\ncomment TextureFile b.png\n"
    found = read(tmp_path, head("ascii", pictures, 3, face), text_rows([*PLACES, *rows]))
    look = found.source.look
    height, width = look.picture.shape[:2]
    x, y = (look.uv.mean(axis=1) * (1, -1) + (0, 1)).T * [[width], [height]]
    assert look.picture[y.astype(int), x.astype(int)].tolist() == [[255, 0, 0], [0, 0, 255], [255] * 3]


def test_strips_with_colours(tmp_path):
    lines = head("ascii", "property uchar red\nproperty uchar green\nproperty uchar blue\n", 0)
    lines = lines.replace(
        "element face 0\nproperty list uchar int", "element tristrips 1\nproperty list int int"
    )
    rows = [[*place, *rgb] for place, rgb in zip(PLACES, RGB, strict=True)]
    found = read(tmp_path, lines, text_rows([*rows, [8, 0, 1, 3, 2, -1, 0, 1, 4]]))
    assert found.F.tolist() == [[0, 1, 3], [3, 1, 2], [0, 1, 4]]
    assert found.source.look.rgb.tolist() == np.array(RGB)[found.F].tolist()


@pytest.mark.parametrize("size", [-5, 2**31 - 1])
def test_a_list_of_impossible_length_has_its_sentence(tmp_path, size):
    face = "property list int int vertex_indices\n"
    data = np.array(PLACES, np.float32).tobytes() + np.array([3, 0, 1, 2, size, 0, 1, 2], np.int32).tobytes()
    with pytest.raises(InputError, match="row 1 of its 2 elements 'face'"):
        read(tmp_path, head("binary_little_endian", faces=2, face=face), data)


def test_faces_that_can_not_be_read_are_counted(tmp_path):
    strip = [(k // 2, k % 2, 0) for k in range(22)]
    faces = [[3, k, k + 1, k + 2] for k in range(20)]
    lines = head("ascii", count=22, faces=20)
    few = read(tmp_path, lines, text_rows([*strip, *faces[:-1], [3, 1, "x", 2]]))
    assert len(few.F) == 19
    assert "1 of 20 faces are left out" in few.notes[0]
    with pytest.raises(InputError, match="5 of its 20 faces can't be read"):
        read(tmp_path, lines, text_rows([*strip, *faces[:-5], *[[3, 1, 2, 99]] * 5]))


@pytest.mark.parametrize("line", ["format odd 1.0", "property list x y z", "element face", "property float"])
def test_heads_without_sense_have_their_sentence(tmp_path, line):
    lines = head("ascii").split("\n")
    lines[1 if line.startswith("format") else 6] = line
    with pytest.raises(InputError, match=r"can't be read|cut off|holds"):
        read(tmp_path, "\n".join(lines), text_rows([*PLACES, *([len(f), *f] for f in MIXED)]))
