import struct

import numpy as np
import trimesh

from meshjig.output.files.mesh_files import write_obj, write_stl
from meshjig.output.piece import Piece
from meshjig.solid.printable import printable
from tests.meshes import genus2, sphere, torus

PIECES = [
    Piece("piece_001", *printable(*sphere(300)), (1.0, 0.2, 0.0)),
    Piece("piece two", *printable(*torus(500)), (0.0, 0.4, 1.0)),
]

COLOURED = [
    Piece("piece_001", *sphere(300), (1.0, 0.2, 0.0)),
    Piece("piece_002", *torus(500), (0.0, 0.4, 1.0)),
]


def test_stl_holds_every_face_in_order(tmp_path):
    V, F = genus2(700)
    write_stl(tmp_path / "a.stl", V, F, "piece_007")
    content = (tmp_path / "a.stl").read_bytes()
    assert len(content) == 84 + 50 * len(F)
    assert struct.unpack("<I", content[80:84]) == (len(F),)
    numbers = struct.unpack("<12fH", content[84 + 50 * 41 : 84 + 50 * 42])
    np.testing.assert_array_equal(np.reshape(numbers[3:12], (3, 3)), V[F[41]].astype("f4"))
    read = trimesh.load_mesh(tmp_path / "a.stl")
    assert read.is_watertight
    np.testing.assert_allclose(read.triangles, V[F], atol=1e-5)


def test_normals_point_outward(tmp_path):
    V, F = genus2(700)
    write_stl(tmp_path / "a.stl", V, F)
    raw = np.frombuffer((tmp_path / "a.stl").read_bytes()[84:], "V50").view(
        [("normal", "<f4", 3), ("rest", "V38")]
    )
    np.testing.assert_allclose(raw["normal"], trimesh.Trimesh(V, F, process=False).face_normals, atol=1e-4)


def test_header_tells_maker_name_and_unit_and_does_not_look_like_ascii(tmp_path):
    V, F = genus2(700)
    write_stl(tmp_path / "a.stl", V, F, "piece_007" + 90 * "x")
    header = (tmp_path / "a.stl").read_bytes()[:80]
    assert b"meshjig" in header
    assert b"mm" in header
    assert b"piece_007" in header
    assert not header.lower().startswith(b"solid")


def parsed(path):
    """Read V, and per group its material and faces."""
    V, groups = [], {}
    for line in path.read_text().splitlines():
        word, *rest = line.split()
        if word == "v":
            V.append([float(x) for x in rest])
        elif word == "g":
            material, faces = None, []
            groups[rest[0]] = [material, faces]
        elif word == "usemtl":
            groups[list(groups)[-1]][0] = rest[0]
        elif word == "f":
            faces.append([int(x) - 1 for x in rest])
    return np.array(V), groups


def test_obj_has_a_group_and_a_colour_a_piece(tmp_path):
    write_obj(tmp_path / "puzzle.obj", PIECES)
    V, groups = parsed(tmp_path / "puzzle.obj")
    materials = (tmp_path / "puzzle.mtl").read_text()
    assert "mtllib puzzle.mtl" in (tmp_path / "puzzle.obj").read_text()
    assert list(groups) == ["piece_001", "piece_two"]
    for (material, faces), piece in zip(groups.values(), PIECES, strict=True):
        np.testing.assert_array_equal(V[np.array(faces)].astype("f4"), piece.V[piece.F])
        block = materials.split(f"newmtl {material}\n")[1].splitlines()[0]
        np.testing.assert_allclose([float(x) for x in block.split()[1:]], piece.colour, atol=1e-4)
