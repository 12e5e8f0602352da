"""The facts of a scan are those of the shape that went in."""

import numpy as np
import pytest
import trimesh

from meshjig.scan import describe, read_scan
from tests.meshes import (
    closed_cylinder,
    creased_box,
    cylinder,
    disc,
    genus2,
    half_sphere,
    joined,
    moved,
    open_cup,
    saddle,
    sphere,
    torus,
    two_components,
)


@pytest.mark.parametrize(
    ("maker", "components", "borders", "genus"),
    [
        (sphere, 1, 0, 0),
        (torus, 1, 0, 1),
        (genus2, 1, 0, 2),
        (creased_box, 1, 0, 0),
        (closed_cylinder, 1, 0, 0),
        (cylinder, 1, 2, 0),
        (open_cup, 1, 1, 0),
        (half_sphere, 1, 1, 0),
        (saddle, 1, 1, 0),
        (disc, 1, 1, 0),
        (two_components, 2, 0, 1),
    ],
)
def test_topology_is_that_of_the_shape(maker, components, borders, genus):
    facts = read_scan(maker(800)).facts
    assert (facts.components, facts.borders, facts.genus) == (components, borders, genus)


def test_equal_input_gives_equal_geometry(tmp_path):
    path = tmp_path / "model.stl"
    path.write_bytes(trimesh.Trimesh(*torus(3000), process=False).export(file_type="stl"))
    first, second = (read_scan(path, size=80, faces=1000) for _ in range(2))
    np.testing.assert_array_equal(first.mesh.V, second.mesh.V)
    np.testing.assert_array_equal(first.mesh.F, second.mesh.F)
    assert first.facts == second.facts


def test_the_mesh_leads_back_to_the_loaded_one(tmp_path):
    source = trimesh.Trimesh(*moved(torus(800), [3e4, 0, 0]), process=False)
    scan = read_scan(source, size=60)
    back = trimesh.transform_points(scan.mesh.V, scan.to_source)
    assert np.array_equal(scan.source.vertices[scan.source.faces], source.triangles)
    np.testing.assert_allclose(back, source.vertices, atol=1e-6)


def test_a_description_counts_what_is_wrong():
    mesh = joined(sphere(300), moved(sphere(300), [40, 3, 2]))
    facts = describe((mesh.V, np.concatenate([mesh.F, mesh.F[:2]])))
    assert facts.faces == len(mesh.F) + 2
    assert facts.working_faces == len(mesh.F)
    assert facts.self_crossings > 20
    assert facts.repairs.duplicate_faces == 2
