import numpy as np

from meshjig.output.files.obj import write_obj
from meshjig.output.piece import Piece
from meshjig.solid.printable import printable
from tests.meshes import sphere, torus

PIECES = [
    Piece("piece_001", *printable(*sphere(300)), (1.0, 0.2, 0.0)),
    Piece("piece two", *printable(*torus(500)), (0.0, 0.4, 1.0)),
]


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
