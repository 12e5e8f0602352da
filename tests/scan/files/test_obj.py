"""OBJ files: corners by number, from the start or backwards, with whatever stands beside them."""

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.mesh.components import components
from meshjig.scan.load import load
from tests.meshes import sphere

SQUARE = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\n"


def read(folder, text, name="model.obj"):
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return load(path)


def test_relative_numbers_count_back_from_where_they_stand(tmp_path):
    V, F = sphere(100)
    ball = [f"v {x} {y} {{z}}\n" for x, y in V[:, :2]]
    text = ""
    for k in range(3):
        text += "".join(line.format(z=z + 100 * k) for line, z in zip(ball, V[:, 2], strict=True))
        text += "".join(f"f {a} {b} {c}\n" for a, b, c in F - len(V))
    found = read(tmp_path, text)
    assert len(found.F) == 3 * len(F)
    assert components(found.F)[0] == 3
    assert np.ptp(found.V, axis=0) == pytest.approx(np.ptp(V, axis=0) + np.array([0, 0, 200]))
    assert found.source.vertices[found.F[-1]].tolist() == (V[F[-1]] + [0, 0, 200]).tolist()


SPELLINGS = ["1 2 3 4", "1/1 2/2 3/3 4/4", "1//1 2//1 3//1 4//1", "1/1/1 2/2/1 3/3/1 4/4/1", "1/ 2/ 3/ 4/"]
SPELLINGS += ["-4 -3 -2 -1", "-4/-4 -3/-3 -2/-2 -1/-1", "1/1 2 3//1 4/4/1", "1 2 3 \\\n 4", "1 2 3 4 # all"]


@pytest.mark.parametrize("face", [*SPELLINGS, "\t1\t2 3   4 "])
def test_corners_in_every_spelling(tmp_path, face):
    found = read(
        tmp_path, f"{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nl 1 2 3\np 1\ng a\ns off\nf {face}\n"
    )
    assert found.F.tolist() == [[0, 1, 2], [2, 3, 0]]
    assert found.notes == []
    uv = found.source.look.uv
    if uv is not None and "1 2 3" not in face:
        known = np.isfinite(uv).all(axis=(1, 2))
        assert (uv[known] * 9 == found.V[found.F][known, :, :2]).all()


@pytest.mark.parametrize("coding", ["utf-16", "utf-8-sig", "windows", "mac"])
def test_text_in_other_codings(tmp_path, coding):
    text = f"# größe\n{SQUARE}f 1 2 3 4\n"
    line = {"windows": "\r\n", "mac": "\r"}.get(coding)
    data = text.replace("\n", line).encode() if line else text.encode(coding)
    assert read(tmp_path, data).F.tolist() == [[0, 1, 2], [2, 3, 0]]


def test_faces_that_name_nothing_are_counted(tmp_path):
    strip = "".join(f"v {k} 0 0\nv {k} 1 0\n" for k in range(20)) + "".join(
        f"f {2 * k + 1} {2 * k + 3} {2 * k + 4} {2 * k + 2}\n" for k in range(19)
    )
    found = read(tmp_path, f"{strip}f 1 2 99\n")
    assert len(found.F) == 38
    assert "1 of 20 faces are left out" in found.notes[0]
    with pytest.raises(InputError, match="3 of its 22 faces can't be read"):
        read(tmp_path, strip + "f 1 2 99\nf 1 2 x\nf 1 2\n")


def test_vertices_of_no_face_are_told(tmp_path):
    more = "".join(f"v {k} 5 5\n" for k in range(3))
    assert "3 of its 7 vertices belong to no face" in read(tmp_path, f"{SQUARE}{more}f 1 2 3 4\n").notes[0]


def test_a_decimal_comma(tmp_path):
    found = read(tmp_path, SQUARE.replace("9", "9,5") + "f 1 2 3 4\n")
    assert found.V.max() == 9.5


def test_colours_of_vertices_in_all_scales(tmp_path):
    wanted = [[[255, 0, 0], [0, 255, 0], [0, 0, 255]]]
    corners = ["0 0 0", "9 0 0", "0 9 0"]
    for colours in (["1 0 0", "0 1 0", "0 0 1"], ["255 0 0", "0 255 0", "0 0 255"]):
        text = "".join(f"v {a} {b}\n" for a, b in zip(corners, colours, strict=True))
        assert read(tmp_path, text + "f 1 2 3\n").source.look.rgb.tolist() == wanted
    painted = "#MRGB ffff0000ff00ff00\n#MRGB ff0000ff\n"
    text = "".join(f"v {a}\n" for a in corners) + painted + "f 1 2 3\n"
    assert read(tmp_path, text).source.look.rgb.tolist() == wanted


def test_vertices_without_colours_among_others_are_white(tmp_path):
    text = "v 0 0 0 1 0 0\nv 9 0 0 0 1 0\nv 0 9 0\nf 1 2 3\n"
    assert read(tmp_path, text).source.look.rgb.tolist() == [[[255, 0, 0], [0, 255, 0], [255] * 3]]
    stray = read(
        tmp_path, text.replace(" 1 0 0\nv", "\nv").replace(" 0 1 0\n", "\n").replace("9 0\n", "9 0 1 1 1\n")
    )
    assert stray.source.look.rgb is None


def test_free_forms_are_told(tmp_path):
    assert "free-form" in read(tmp_path, f"{SQUARE}f 1 2 3 4\ncstype bezier\nsurf 0 1 0 1 1 2 3 4\n").notes[0]
