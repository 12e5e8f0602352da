"""Every reader gives the surface that was written; every bad input its own sentence."""

import sys

import numpy as np
import pytest
import trimesh

from meshjig.errors import InputError
from meshjig.mesh.measure import face_areas, mesh_volume
from meshjig.scan import read_scan
from meshjig.scan.load import load
from meshjig.scan.scale import import_pymeshlab
from tests.meshes import Shape, joined, moved, sphere, torus

FORMATS = ["stl", "obj", "ply", "off", "glb"]


def written(folder, kind, mesh=None, **options):
    path = folder / f"model.{kind}"
    data = trimesh.Trimesh(*(mesh or torus(500)), process=False).export(file_type=kind, **options)
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return path


@pytest.mark.parametrize("kind", FORMATS)
def test_a_file_gives_the_surface_that_was_written(tmp_path, kind):
    V, F = torus(500)
    read = load(written(tmp_path, kind))
    assert len(read.F) == len(F)
    assert face_areas(read.V, read.F).sum() == pytest.approx(face_areas(V, F).sum(), rel=1e-5)
    assert mesh_volume(read.V, read.F) == pytest.approx(mesh_volume(V, F), rel=1e-5)
    np.testing.assert_array_equal(read.source.vertices, read.V)


def test_arrays_a_trimesh_and_a_scene_give_the_same():
    shape = sphere(200)
    mesh = trimesh.Trimesh(*shape, process=False)
    for source in (tuple(shape), (shape.V.tolist(), shape.F.astype(np.uint32)), mesh, trimesh.Scene([mesh])):
        read = load(source)
        np.testing.assert_array_equal(read.V, shape.V)
        np.testing.assert_array_equal(read.F, shape.F)


def test_a_scene_is_joined_with_each_part_in_its_place(tmp_path):
    part = trimesh.Trimesh(*sphere(200), process=False)
    scene = trimesh.Scene()
    scene.add_geometry(part)
    scene.add_geometry(part, transform=trimesh.transformations.translation_matrix([200, 0, 0]))
    path = tmp_path / "scene.glb"
    path.write_bytes(scene.export(file_type="glb"))
    read = load(path)
    assert len(read.F) == 2 * len(part.faces)
    assert np.ptp(read.V, axis=0) == pytest.approx(part.extents + np.array([200, 0, 0]), rel=1e-5)


def test_3mf_is_read_with_its_unit_and_its_transforms(tmp_path):
    import lib3mf

    V, F = torus(500)
    model = lib3mf.get_wrapper().CreateModel()
    model.SetUnit(lib3mf.ModelUnit.CentiMeter)
    mesh = model.AddMeshObject()
    points = [lib3mf.Position() for _ in V]
    for point, xyz in zip(points, V, strict=True):
        point.Coordinates[:] = list(xyz)
    triangles = [lib3mf.Triangle() for _ in F]
    for triangle, corners in zip(triangles, F, strict=True):
        triangle.Indices[:] = corners.tolist()
    mesh.SetGeometry(points, triangles)
    for x in (0, 150):
        model.AddBuildItem(mesh, lib3mf.get_wrapper().GetTranslationTransform(x, 0, 0))
    path = tmp_path / "model.3mf"
    model.QueryWriter("3mf").WriteToFile(str(path))
    read = load(path)
    assert len(read.F) == 2 * len(F)
    assert read.source.unit.mm == 10
    assert np.ptp(read.V, axis=0) == pytest.approx(np.ptp(V, axis=0) + np.array([150, 0, 0]), rel=1e-5)


def test_uvs_stay_with_the_source(tmp_path):
    path = tmp_path / "model.obj"
    path.write_text("v 0 0 0\nv 9 0 0\nv 0 9 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
    assert load(path).source.look.uv.tolist() == [[[0, 0], [1, 0], [0, 1]]]


def test_the_second_reader_reads_what_the_first_can_not(tmp_path):
    """A PLY file of text whose rows go over several lines."""
    path = tmp_path / "rows.ply"
    head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    faces = "element face 2\nproperty list int int vertex_indices\nend_header\n"
    path.write_text(f"{head}{faces}0 0\n0\n9 0\n0\n0 9 0\n9 9 1\n3\n0 1 2\n3 1\n3 2\n")
    read = load(path)
    assert read.reader == "pymeshlab"
    assert len(read.F) == 2


def test_a_reader_that_crashes_leaves_a_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr("meshjig.runtime.bounded._READER", ("os", "abort"))
    with pytest.raises(InputError, match="makes its reader crash"):
        load(written(tmp_path, "ply"))


@pytest.mark.parametrize(
    ("library", "package"),
    [("libGL.so.1", "libgl1"), ("libOpenGL.so.0", "libopengl0"), ("libEGL.so.1", "libegl1")],
)
def test_a_missing_system_library_is_named(monkeypatch, library, package):
    class Missing:
        def find_spec(self, name, path=None, target=None):
            if name == "pymeshlab":
                raise ImportError(f"{library}: cannot open shared object file: No such file or directory")

    monkeypatch.delitem(sys.modules, "pymeshlab", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Missing(), *sys.meta_path])
    with pytest.raises(InputError, match=f"{package} "):
        import_pymeshlab()


@pytest.mark.parametrize("kind", [*FORMATS, "3mf", "gltf"])
@pytest.mark.parametrize("share", [0.02, 0.3, 0.6, 0.97])
def test_a_cut_off_file_says_so(tmp_path, kind, share):
    path = tmp_path / f"model.{kind}"
    whole = b"x" * 1000 if kind in ("3mf", "gltf") else written(tmp_path, kind).read_bytes()
    end = int(len(whole) * share)
    if kind == "obj":  # has no end mark: cut inside a line
        end = whole.rindex(b" ", 0, end)
    path.write_bytes(whole[:end])
    with pytest.raises(InputError, match="cut off"):
        load(path)


@pytest.mark.parametrize("share", [0.3, 0.6, 0.97])
@pytest.mark.parametrize(("kind", "options"), [("ply", {"encoding": "ascii"}), ("stl_ascii", {})])
def test_a_cut_off_text_file_says_so(tmp_path, kind, options, share):
    written(tmp_path, kind, **options).rename(tmp_path / f"cut.{kind[:3]}")
    path = tmp_path / f"cut.{kind[:3]}"
    whole = path.read_bytes()
    path.write_bytes(whole[: int(len(whole) * share)])
    with pytest.raises(InputError, match="is cut off"):
        load(path)


@pytest.mark.parametrize("kind", [*FORMATS, "3mf", "gltf"])
def test_an_empty_file_and_noise_have_their_sentences(tmp_path, kind):
    path = tmp_path / f"model.{kind}"
    path.write_bytes(b"")
    with pytest.raises(InputError, match="is empty"):
        load(path)
    path.write_bytes(np.random.default_rng(0).integers(0, 256, 3000, np.uint8).tobytes())
    with pytest.raises(InputError, match=r"damaged|cut off"):
        load(path)


def test_a_path_that_is_no_mesh_file_has_its_sentence(tmp_path):
    (tmp_path / "part.step").write_text("x")
    for name, sentence in [
        ("none.stl", "does not exist"),
        ("", "is a folder"),
        ("part.step", "does not know: it reads 3mf, glb, gltf, obj, off, ply, stl"),
    ]:
        with pytest.raises(InputError, match=sentence):
            load(tmp_path / name)


def test_points_without_faces_have_their_sentence(tmp_path):
    path = tmp_path / "points.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    for source in (path, (sphere(100).V, np.zeros((0, 3), int)), trimesh.PointCloud(sphere(100).V)):
        with pytest.raises(InputError, match="points but no faces"):
            load(source)
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
    with pytest.raises(InputError, match="damaged"):
        load(path)
    with pytest.raises(InputError, match="holds no faces"):
        load(trimesh.Scene())


V, F = sphere(100)
NAN = np.where(np.arange(len(V))[:, None] == 7, np.nan, V)


@pytest.mark.parametrize(
    ("source", "sentence"),
    [
        ((V[:, :2], F), r"V has shape \(42, 2\)"),
        ((V, F[:, :2]), r"F has shape \(80, 2\)"),
        ((V, F.astype(float)), "F holds float64"),
        ((V.astype(complex), F), "V holds complex128"),
        ((V, [[0, 1, 2], [0, 1]]), "differ in length"),
        ((V, F + 1), "42 vertices and names others in 5 of its 80 faces"),
        ((V, F - 1), "42 vertices and names others in 5 of its 80 faces"),
        ((NAN, F), "not numbers .* in 1 of its 42 vertices"),
        ((np.where(np.isnan(NAN), np.inf, NAN), F), "not numbers .* in 1 of its 42 vertices"),
        ((V * [1, 0, 0], F), "no area"),
        ((V * 0 + 5, F), "no area"),
        ((V * 1e40, F), "beyond any unit"),
        ((V * 1e-40, F), "beyond any unit"),
        (3, "a int is no mesh"),
    ],
)
def test_arrays_that_are_no_surface_have_their_sentence(source, sentence):
    with pytest.raises(InputError, match=sentence):
        read_scan(source)


def test_vertices_that_no_face_uses_may_be_anything():
    far = Shape(np.concatenate([V, [[np.nan, 0, 0], [1e40, 0, 0]]]), F)
    scan = read_scan(far)
    assert len(scan.mesh.V) == len(V)
    assert scan.facts.repairs.unused_vertices == 2


def test_an_stl_of_two_bodies_gives_two_components(tmp_path):
    path = written(tmp_path, "stl", joined(sphere(300), moved(torus(300), [130, 0, 0])))
    facts = read_scan(path).facts
    assert (facts.components, facts.borders, facts.genus) == (2, 0, 1)


def test_a_drawing_of_trimesh_is_no_surface():
    drawing = trimesh.load_path(np.array([[0.0, 0], [1, 0], [1, 1], [0, 0]]))
    with pytest.raises(InputError, match=r"^a Path2D is no surface: .*extrude"):
        load(drawing)
    flat = trimesh.load_path(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 0, 0]]))
    with pytest.raises(InputError, match="points but no faces"):
        load(flat)
