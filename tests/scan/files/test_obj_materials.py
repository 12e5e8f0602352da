"""Materials of OBJ files: several of them, and what of theirs is missing."""

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
