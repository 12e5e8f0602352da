import lib3mf
import numpy as np
import pytest

from meshjig.errors import OutputError
from meshjig.output.files.threemf import write_3mf
from meshjig.output.piece import Piece
from tests.meshes import creased_box, sphere, torus

PIECES = [
    Piece("piece_001", *sphere(300), (1.0, 0.2, 0.0)),
    Piece("piece_002 <ä & b>", *torus(500), (0.0, 0.4, 1.0)),
    Piece("piece_003", *creased_box(300), (0.6, 0.6, 0.6)),
]


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("3mf") / "puzzle.3mf"
    write_3mf(path, PIECES)
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    assert reader.GetWarningCount() == 0
    return model


def objects(model):
    iterator = model.GetMeshObjects()
    while iterator.MoveNext():
        yield iterator.GetCurrentMeshObject()


def test_each_piece_is_a_named_manifold_object_with_its_geometry(model):
    assert [m.GetName() for m in objects(model)] == [piece.name for piece in PIECES]
    for mesh, piece in zip(objects(model), PIECES, strict=True):
        assert mesh.IsManifoldAndOriented()
        V = np.array([list(p.Coordinates) for p in mesh.GetVertices()])
        F = np.array([list(t.Indices) for t in mesh.GetTriangleIndices()])
        np.testing.assert_allclose(V, piece.V, atol=1e-5)
        np.testing.assert_array_equal(F, piece.F)


def test_each_object_has_its_colour(model):
    for mesh, piece in zip(objects(model), PIECES, strict=True):
        resource, material, has_property = mesh.GetObjectLevelProperty()
        assert has_property
        colour = model.GetBaseMaterialGroupByID(resource).GetDisplayColor(material)
        assert [colour.Red, colour.Green, colour.Blue] == [round(255 * c) for c in piece.colour]


def test_every_object_is_built_once_in_mm(model):
    assert model.GetUnit() == lib3mf.ModelUnit.MilliMeter
    items = model.GetBuildItems()
    assert items.Count() == len(PIECES)


def test_a_path_that_cannot_be_written_is_told(tmp_path):
    with pytest.raises(OutputError, match=r"puzzle\.3mf"):
        write_3mf(tmp_path / "nowhere" / "puzzle.3mf", PIECES)


def test_equal_pieces_give_equal_bytes_and_others_do_not(tmp_path):
    for name, pieces in (("a", PIECES), ("b", PIECES), ("c", PIECES[:2])):
        write_3mf(tmp_path / name, pieces)
    a, b, c = ((tmp_path / name).read_bytes() for name in "abc")
    assert a == b != c
