"""Refining and simplifying keep what a mesh is: its topology, its borders, its shape."""

import numpy as np
import pytest

from meshjig.mesh.measure import mesh_volume
from meshjig.scan import decimate, read_scan
from tests.meshes import (
    border,
    creased_box,
    cylinder,
    genus2,
    half_sphere,
    noisy,
    open_cup,
    sphere,
    topology,
    torus,
    two_components,
)


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
