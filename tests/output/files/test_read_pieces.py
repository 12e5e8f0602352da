import struct
import time

import lib3mf
import numpy as np
import pytest
import trimesh

from meshjig.check import is_closed
from meshjig.errors import InputError
from meshjig.mesh.measure import mesh_volume
from meshjig.output.files.glb import write_glb
from meshjig.output.files.mesh_files import write_obj
from meshjig.output.files.read_pieces import read_pieces
from meshjig.output.piece import Piece
from tests.meshes import moved, sphere, torus

BALL = sphere(300)


def write(path, mesh, **how):
    path.parent.mkdir(parents=True, exist_ok=True)
    trimesh.Trimesh(*mesh, process=False).export(path, **how)
    return path


def write_3mf(path, parts, unit=lib3mf.ModelUnit.MilliMeter):
    """Write parts (name, mesh, shift), each built with its shift; through components where there are two."""
    wrapper = lib3mf.get_wrapper()
    model = wrapper.CreateModel()
    model.SetUnit(unit)
    for name, mesh, shifts in parts:
        made = model.AddMeshObject()
        made.SetName(name)
        made.SetGeometry(
            [lib3mf.Position(tuple(map(float, p))) for p in mesh.V],
            [lib3mf.Triangle(tuple(map(int, f))) for f in mesh.F],
        )
        build = made
        if len(shifts) == 2:
            build = model.AddComponentsObject()
            build.AddComponent(made, wrapper.GetTranslationTransform(*shifts[1]))
        if shifts:
            model.AddBuildItem(build, wrapper.GetTranslationTransform(*shifts[0]))
    model.QueryWriter("3mf").WriteToFile(str(path))
    return path


@pytest.mark.parametrize("format", ["stl", "stl_ascii", "obj", "ply"])
def test_every_format_gives_the_closed_mesh_back(tmp_path, format):
    path = write(tmp_path / f"ball.{format[:3]}", BALL, file_type=format)
    [(name, V, F)] = read_pieces(path)
    assert name == "ball"
    assert is_closed(F)
    assert len(V) == len(BALL.V)
    assert len(F) == len(BALL.F)
    assert (V.dtype, F.dtype) == (np.float64, np.int64)
    np.testing.assert_allclose(V[F], BALL.V[BALL.F], rtol=1e-6, atol=1e-5)


@pytest.mark.parametrize("coding", ["utf-8-sig", "utf-16"])
def test_a_text_stl_may_begin_with_a_byte_order_mark(tmp_path, coding):
    path = write(tmp_path / "ball.stl", BALL, file_type="stl_ascii")
    path.write_bytes(path.read_text().encode(coding))
    [(_, V, F)] = read_pieces(path)
    assert is_closed(F)
    assert (len(V), len(F)) == (len(BALL.V), len(BALL.F))


def test_a_damaged_text_stl_is_told(tmp_path):
    path = write(tmp_path / "ball.stl", BALL, file_type="stl_ascii")
    path.write_text(path.read_text().replace("vertex", "vertex x", 1))
    with pytest.raises(InputError, match=r"ball\.stl is damaged: 1 of its \d+ facets can't be read"):
        read_pieces(path)


def test_vertices_merge_only_when_they_are_equal(tmp_path):
    near = np.float32(1) + np.finfo(np.float32).eps
    facets = [[(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(-0.0, 0, 0), (0, 1, 0), (near, 0, 0)]]
    body = b"".join(struct.pack("<12fH", 0, 0, 1, *np.ravel(f), 0) for f in facets)
    (tmp_path / "a.stl").write_bytes(bytes(80) + struct.pack("<I", 2) + body)
    [(_, V, F)] = read_pieces(tmp_path / "a.stl")
    assert len(V) == 4
    assert F[0, 0] == F[1, 0]
    assert F[0, 1] != F[1, 2]


def test_a_binary_file_may_begin_with_solid(tmp_path):
    path = write(tmp_path / "ball.stl", BALL)
    path.write_bytes(b"solid of revolution".ljust(80) + path.read_bytes()[80:])
    assert is_closed(read_pieces(path)[0][2])


def test_pieces_come_in_natural_order(tmp_path):
    for k in (10, 9, 2, 1):
        write(tmp_path / f"piece_{k}.stl", BALL)
    (tmp_path / "notes.txt").write_text("not a piece")
    assert [name for name, _, _ in read_pieces(tmp_path)] == ["piece_1", "piece_2", "piece_9", "piece_10"]


def test_a_puzzle_folder_is_read_from_its_pieces_else_from_its_package(tmp_path):
    write_3mf(tmp_path / "puzzle.3mf", [("whole", BALL, [(0, 0, 0)])])
    assert [name for name, _, _ in read_pieces(tmp_path)] == ["whole"]
    write(tmp_path / "pieces" / "piece_001.stl", BALL)
    write(tmp_path / "pieces" / "piece_001.obj", BALL)
    assert [name for name, _, _ in read_pieces(tmp_path)] == ["piece_001"]


@pytest.mark.parametrize("format", ["obj", "glb"])
def test_a_puzzle_saved_as_one_file_comes_back_in_pieces(tmp_path, format):
    pieces = [
        Piece("piece_001", *BALL, (0.1, 0.2, 0.3)),
        Piece("piece_002", *moved(torus(200), [0, 0, 200]), (0.3, 0.2, 0.1)),
    ]
    {"obj": write_obj, "glb": write_glb}[format](tmp_path / f"puzzle.{format}", pieces)
    for (name, V, F), piece in zip(read_pieces(tmp_path), pieces, strict=True):
        assert name == piece.name
        assert is_closed(F)
        np.testing.assert_allclose(V[F], piece.V[piece.F], rtol=1e-6, atol=1e-4)


def test_groups_of_a_strange_obj_are_one_piece(tmp_path):
    path = write(tmp_path / "ball.obj", BALL)
    lines = path.read_text().splitlines()
    half = max(i for i, line in enumerate(lines) if line.startswith("f ")) - 50
    path.write_text("\n".join([*lines[:half], "g rest", *lines[half:]]))
    [(_, _, F)] = read_pieces(path)
    assert is_closed(F)


def test_several_paths_are_read_in_their_order(tmp_path):
    paths = [write(tmp_path / "b.ply", BALL), write(tmp_path / "a.stl", torus(200))]
    assert [name for name, _, _ in read_pieces(paths)] == ["b", "a"]


def test_a_package_gives_its_built_objects_in_place(tmp_path):
    parts = [
        ("near", BALL, [(0, 0, 0)]),
        ("far", BALL, [(100, 0, -7)]),
        ("nested", BALL, [(100, 0, 0), (0, 20, 0)]),
        ("spare", BALL, []),
    ]
    read = {name: (V, F) for name, V, F in read_pieces(write_3mf(tmp_path / "p.3mf", parts))}
    assert list(read) == ["near", "far", "nested"]
    for name, centre in (("near", (0, 0, 0)), ("far", (100, 0, -7)), ("nested", (100, 20, 0))):
        V, F = read[name]
        assert is_closed(F)
        np.testing.assert_allclose((V.min(0) + V.max(0)) / 2, np.array(centre), atol=0.01)
        assert mesh_volume(V, F) == pytest.approx(mesh_volume(*BALL), rel=1e-5)


def test_a_package_in_inches_is_read_in_mm(tmp_path):
    path = write_3mf(tmp_path / "p.3mf", [("ball", BALL, [(1, 0, 0)])], lib3mf.ModelUnit.Inch)
    [(_, V, _)] = read_pieces(path)
    np.testing.assert_allclose(V.max(0)[0], 25.4 * (BALL.V[:, 0].max() + 1), rtol=1e-6)


@pytest.mark.parametrize(
    ("name", "content", "what"),
    [
        ("a.stl", b"", "is empty"),
        (
            "a.stl",
            bytes(80) + struct.pack("<I", 9) + bytes(120),
            "cut short: it announces 9 facets, and holds 2",
        ),
        ("a.stl", bytes(84), "no faces"),
        ("a.stl", bytes(80) + struct.pack("<I", 1) + struct.pack("<12fH", *[np.nan] * 12, 0), "finite"),
        ("a.stl", bytes(80) + struct.pack("<I", 1) + bytes(50), "no faces"),
        ("a.stl", b"hello", "is cut off"),
        ("a.obj", b"", "is empty"),
        ("a.ply", b"ply\nformat ascii 1.0\nelement vertex 3\n", "can't be read as PLY"),
        ("a.3mf", b"PK\x03\x04 no package", "can't be read as 3MF"),
        ("a.glb", b"glTF", "can't be read as GLB"),
        ("a.obj", b"# meshjig\nv 0 0 0\ng p\nf 1 1\n", "damaged"),
        ("a.obj", b"# meshjig\nv 0 0 0\ng p\nf 1 1 9\n", "do not exist"),
        ("a.docx", b"text", "unknown format"),
    ],
)
def test_files_that_hold_no_piece_get_a_sentence(tmp_path, name, content, what):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=what) as caught:
        read_pieces(tmp_path / name)
    assert name in str(caught.value)
    assert "\n" not in str(caught.value)


def test_nothing_found_is_said(tmp_path):
    with pytest.raises(InputError, match="no pieces found"):
        read_pieces(tmp_path)
    with pytest.raises(InputError, match="does not exist"):
        read_pieces(tmp_path / "nowhere")
    with pytest.raises(InputError, match="no files"):
        read_pieces([])
    with pytest.raises(InputError, match="no objects to build"):
        read_pieces(write_3mf(tmp_path / "p.3mf", [("spare", BALL, [])]))


def test_a_hundred_pieces_are_read_in_a_second(tmp_path):
    path = write(tmp_path / "p.stl", sphere(8000))
    start = time.process_time()
    read_pieces([path] * 100)
    assert time.process_time() - start < 2.0  # 0.3 s on an idle machine
