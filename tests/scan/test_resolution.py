"""Refining and simplifying keep what a mesh is: its topology, its borders, its shape."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.measure import face_areas, mesh_volume
from meshjig.scan import decimate, read_scan, refine_long_edges
from meshjig.topology import edges
from tests.meshes import (
    creased_box,
    cylinder,
    genus2,
    half_sphere,
    noisy,
    open_cup,
    sphere,
    torus,
    two_components,
)
from tests.strategies import meshes


def topology(F):
    e = edges(F)
    return len(np.unique(F)) - len(e.E) + len(F), int((e.n_faces > 2).sum())


def border(V, F):
    e = edges(F)
    ends = V[e.E[e.n_faces == 1]]
    return ends, np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum()


@given(meshes(faces=(100, 600)), st.floats(1.0, 40.0))
@settings(max_examples=30, deadline=None)
def test_refining_conforms_and_keeps_the_surface(mesh, length):
    V, F = refine_long_edges(*mesh, length)
    ends = V[edges(F).E]
    assert np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).max() <= length
    np.testing.assert_array_equal(V[: len(mesh.V)], mesh.V)
    assert topology(F) == topology(mesh.F)  # a T-junction would open a border and change Euler's number
    assert border(V, F)[1] == pytest.approx(border(*mesh)[1])
    assert face_areas(V, F).sum() == pytest.approx(face_areas(*mesh).sum())
    assert face_areas(V, F).min() > 0
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*mesh), rel=1e-9, abs=1e-6)


def test_short_edges_are_left_alone():
    mesh = sphere(500)
    V, F = refine_long_edges(*mesh, 1000.0)
    assert V is mesh.V
    assert F is mesh.F


@pytest.mark.parametrize("maker", [sphere, torus, genus2, creased_box, open_cup, cylinder, half_sphere])
def test_simplifying_keeps_topology_borders_and_shape(maker):
    mesh = noisy(maker(4000), 0.05)
    V, F = decimate(*mesh, 1500)
    assert 1400 < len(F) <= 1500
    assert topology(F) == topology(mesh.F)
    assert border(V, F)[1] == pytest.approx(border(*mesh)[1], rel=0.03)
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*mesh), rel=0.01, abs=1.0)
    np.testing.assert_allclose(np.ptp(V, axis=0), np.ptp(mesh.V, axis=0), rtol=0.03)


def test_simplifying_keeps_every_component():
    scan = read_scan(two_components(4000), faces=1000)
    assert scan.facts["components"] == 2
    assert scan.facts["genus"] == 1
    assert scan.facts["working_faces"] == len(scan.mesh.F) <= 1000
    assert scan.facts["decimated_from"] == len(two_components(4000).F)


@pytest.mark.parametrize("faces", [5000, "all"])
def test_a_mesh_within_its_resolution_is_left_alone(faces):
    mesh = torus(4000)
    scan = read_scan(mesh, faces=faces)
    np.testing.assert_array_equal(scan.mesh.F, mesh.F)
    assert scan.facts["decimated_from"] is None
