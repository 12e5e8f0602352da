"""Materials of OBJ files: several of them, and what of theirs is missing."""

import os
import sys

import numpy as np
import pytest
from PIL import Image

from meshjig.scan.load import load
from tests.scan.files.carried import assert_texture
from tests.scan.files.write_text import obj

SQUARES = "".join(f"v {x} 0 0\nv {x + 1} 0 0\nv {x + 1} 1 0\nv {x} 1 0\n" for x in (0, 2, 4))
PLACES = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"


def picture(path, colour):
    Image.new("RGB", (8, 8), colour).save(path)


def shown(source):
    """The colour in the middle of each face."""
    look = source.look
    if look.picture is None:
        return look.rgb[:, 0].tolist()
    height, width = look.picture.shape[:2]
    x, y = (look.uv.mean(axis=1) * (1, -1) + (0, 1)).T * [[width], [height]]
    return look.picture[y.astype(int), x.astype(int)].tolist()


def test_two_pictures_and_a_colour(tmp_path):
    picture(tmp_path / "red.png", (255, 0, 0))
    picture(tmp_path / "blue.png", (0, 0, 255))
    (tmp_path / "a.mtl").write_text("newmtl red\nmap_Kd red.png\nnewmtl green\nKd 0 1 0\n")
    (tmp_path / "b.mtl").write_text("newmtl blue\nmap_Kd -s 2 2 2 blue.png\n")
    faces = [
        f"usemtl {name}\nf {4 * k + 1}/1 {4 * k + 2}/2 {4 * k + 3}/3 {4 * k + 4}/4\n"
        for k, name in enumerate(["blue", "green", "red"])
    ]
    path = tmp_path / "model.obj"
    path.write_text("mtllib a.mtl b.mtl\n" + SQUARES + PLACES + "".join(faces))
    read = load(path)
    assert read.notes == []
    assert shown(read.source) == [[0, 0, 255]] * 2 + [[0, 255, 0]] * 2 + [[255, 0, 0]] * 2


SPELLINGS = ["some%20colours.mtl", "sub\\..\\some colours.mtl", "C:\\Users\\me\\SOME colours.MTL"]


@pytest.mark.parametrize("name", [*SPELLINGS, '"some colours.mtl"', "/home/me/some colours.mtl"])
def test_a_file_of_materials_by_names_as_programs_write_them(tmp_path, name):
    path = obj(tmp_path, "texture")
    (tmp_path / "sub").mkdir()
    path.write_text(path.read_text().replace("some colours.mtl", name))
    read = load(path)
    assert read.notes == []
    assert_texture(read.source)


def test_what_is_missing_is_named(tmp_path):
    path = obj(tmp_path, "texture")
    (tmp_path / "picture.png").unlink()
    assert load(path).notes == ["the picture picture.png is missing: it is left out"]
    (tmp_path / "some colours.mtl").write_text("newmtl other\nKd 1 0 0\n")
    assert load(path).notes == ["no file of materials has 'all': left out"]
    (tmp_path / "some colours.mtl").unlink()
    notes = load(path).notes
    assert notes == ["the file of materials some colours.mtl is missing, and with it colours and pictures"]


def test_a_damaged_picture_leaves_the_surface_and_a_note(tmp_path):
    path = obj(tmp_path, "texture")
    data = bytearray((tmp_path / "picture.png").read_bytes())
    data[data.index(b"IDAT") + 6] ^= 255
    (tmp_path / "picture.png").write_bytes(bytes(data))
    read = load(path)
    assert len(read.F) == 20
    assert "picture.png is damaged" in read.notes[0]


def test_faces_without_places_show_the_colour_of_the_material(tmp_path):
    picture(tmp_path / "red.png", (255, 0, 0))
    (tmp_path / "a.mtl").write_text("newmtl red\nKd 0 0 1\nmap_Kd red.png\n")
    path = tmp_path / "model.obj"
    path.write_text(f"mtllib a.mtl\n{SQUARES}{PLACES}usemtl red\nf 1/1 2/2 3/3 4/4\nf 5 6 7 8\n")
    colours = np.array(shown(load(path).source))
    assert colours.tolist() == [[255, 0, 0]] * 2 + [[0, 0, 255]] * 2


def test_a_picture_without_places_is_named(tmp_path):
    picture(tmp_path / "red.png", (255, 0, 0))
    (tmp_path / "a.mtl").write_text("newmtl red\nmap_Kd red.png\n")
    path = tmp_path / "model.obj"
    path.write_text(f"mtllib a.mtl\n{SQUARES}usemtl red\nf 1 2 3 4\nf 5 6 7 8\nf 9 10 11 12\n")
    assert load(path).notes == ["the picture red.png is left out: no face has a place in it"]


SQUARE = "".join(SQUARES.splitlines(keepends=True)[:4])
ONE = f"{SQUARE}{PLACES}usemtl red\nf 1/1 2/2 3/3 4/4\n"


@pytest.mark.parametrize("name", ["blau.jpg", "C:\\x\\blau.jpg", "/home/me/BLAU.jpg"])
def test_a_picture_is_looked_for_beside_the_file_of_materials_first(tmp_path, name):
    (tmp_path / "sub dir").mkdir()
    picture(tmp_path / "sub dir" / "blau.jpg", (0, 0, 0))
    picture(tmp_path / "blau.jpg", (255, 255, 255))
    (tmp_path / "sub dir" / "m.mtl").write_text(f"newmtl red\nmap_Kd {name}\n")
    path = tmp_path / "model.obj"
    path.write_text("mtllib sub dir/m.mtl\n" + ONE)
    read = load(path)
    assert (read.notes, shown(read.source)) == ([], [[0, 0, 0]] * 2)
    (tmp_path / "sub dir" / "blau.jpg").unlink()
    read = load(path)
    assert (read.notes, shown(read.source)) == ([], [[255, 255, 255]] * 2)


def test_pictures_of_one_name_in_two_folders_are_two(tmp_path):
    for folder, colour in (("a", (255, 0, 0)), ("b", (0, 0, 255))):
        (tmp_path / folder).mkdir()
        picture(tmp_path / folder / "x.png", colour)
        (tmp_path / folder / "m.mtl").write_text(f"newmtl {folder}\nmap_Kd x.png\n")
    path = tmp_path / "model.obj"
    faces = "usemtl a\nf 1/1 2/2 3/3 4/4\nusemtl b\nf 5/1 6/2 7/3 8/4\n"
    path.write_text(f"mtllib a/m.mtl\nmtllib b/m.mtl\n{SQUARES}{PLACES}{faces}")
    assert shown(load(path).source) == [[255, 0, 0]] * 2 + [[0, 0, 255]] * 2


LINUX = pytest.mark.skipif(sys.platform != "linux", reason="names are no bytes here")


@pytest.mark.parametrize("disk", ["utf-8", pytest.param("latin-1", marks=LINUX)])
@pytest.mark.parametrize("text", ["utf-8", "latin-1"])
def test_names_in_latin_1_are_found(tmp_path, disk, text):
    mtl = tmp_path / os.fsdecode("grün.mtl".encode(disk))
    mtl.write_bytes("newmtl röt\nKd 1 0 0\n".encode(text))
    path = tmp_path / "model.obj"
    path.write_bytes(f"mtllib grün.mtl\n{SQUARE}usemtl röt\nf 1 2 3 4\n".encode(text))
    read = load(path)
    assert (read.notes, shown(read.source)) == ([], [[255, 0, 0]] * 2)
