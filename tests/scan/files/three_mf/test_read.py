"""What a 3MF file would have built is read, as large and where it is said to be."""

import numpy as np
import pytest

from meshjig.mesh.measure import mesh_volume
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.three_mf import read_3mf_source
from tests.scan.files.three_mf.build import MODEL, TETRAHEDRON, mesh, model, package, placed


def read(path, *text, **more):
    return read_3mf_source(package(path / "a.3mf", *text, **more), PictureReader())


@pytest.mark.parametrize(
    ("unit", "mm"),
    [
        ("micron", 0.001),
        ("millimeter", 1),
        ("centimeter", 10),
        ("inch", 25.4),
        ("foot", 304.8),
        ("meter", 1000),
    ],
)
def test_the_unit_is_binding(tmp_path, unit, mm):
    source, notes = read(tmp_path, model(mesh(1), unit=unit))
    assert source.unit.mm == mm
    assert source.unit.binding
    assert source.up == "z"
    np.testing.assert_array_equal(source.vertices, TETRAHEDRON)
    assert notes == []


def test_items_and_components_are_placed_one_in_the_other(tmp_path):
    objects = mesh(1) + placed(2, ['objectid="1" transform="2 0 0 0 2 0 0 0 2 100 0 0"', 'objectid="1"'])
    items = '<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 0 0 5"/>'
    source, _ = read(tmp_path, model(objects, items))
    large = np.array([[0, 100, 5], [0, 120, 5], [-20, 100, 5], [0, 100, 25]])
    small = np.array([[0, 0, 5], [0, 10, 5], [-10, 0, 5], [0, 0, 15]])
    np.testing.assert_allclose(source.vertices, np.vstack([large, small]), atol=1e-5)


def test_what_is_mirrored_is_turned_outside_out_again(tmp_path):
    source, _ = read(tmp_path, model(mesh(1), '<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>'))
    assert mesh_volume(source.vertices, source.faces) == pytest.approx(1000 / 6)


def test_only_what_is_to_be_built_is_read_and_the_rest_is_named(tmp_path):
    support = mesh(3).replace('type="model"', 'type="support"')
    objects = mesh(1) + mesh(2) + support
    source, notes = read(tmp_path, model(objects, '<item objectid="1"/><item objectid="3"/>'))
    assert len(source.faces) == 4
    assert notes == [
        "left out: 1 object that the file does not have built",
        "left out: 1 object of support",
    ]


def test_a_file_that_has_nothing_built_is_read_whole(tmp_path):
    source, [note] = read(tmp_path, model(mesh(1) + placed(2, ['objectid="1"']) + mesh(3), ""))
    assert len(source.faces) == 8
    assert "of no object" in note


def test_objects_may_be_in_other_models_of_the_package(tmp_path):
    inner = model(mesh(1, V=TETRAHEDRON + 50), "", required='requiredextensions="p"')
    outer = model(
        placed(2, ['p:path="/3D/Objects/o.model" objectid="1" transform="1 0 0 0 1 0 0 0 1 7 0 0"']),
        '<item objectid="2"/>',
        required='requiredextensions="p"',
    )
    files = {"3D/Objects/o.model": inner}
    source, notes = read(tmp_path, outer, files=files, links=[("3D/Objects/o.model", MODEL)])
    np.testing.assert_allclose(source.vertices, TETRAHEDRON + 50 + [7, 0, 0], atol=1e-5)
    assert notes == []


def test_a_model_without_objects_holds_nothing(tmp_path):
    source, _ = read(tmp_path, model("", ""))
    assert len(source.faces) == 0
