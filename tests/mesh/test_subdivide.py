"""A finer mesh is the same surface, and its finer charts are the same map."""

import igl
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.charts import build_atlas
from meshjig.charts.atlas_distortion import atlas_distortion
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import barycentric, face_areas, interpolate, mesh_volume
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.subdivide import refine_atlas, refine_long_edges
from tests.meshes import border, cylinder, half_sphere, sphere, topology, torus, two_components
from tests.strategies import meshes


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


MAPS = {
    "discs": (sphere(3000), "auto"),
    "torus": (torus(3000), "auto"),
    "open": (half_sphere(3000), "auto"),
    "ring": (cylinder(3000), "periodic"),
    "parts": (two_components(4000), "auto"),
}


@pytest.mark.parametrize("name", MAPS)
@pytest.mark.parametrize("finer", [0.97, 0.6, 0.2])
def test_an_atlas_stays_the_same_map(name, finer):
    mesh, method = MAPS[name]
    atlas = build_atlas(Mesh(*mesh), method=method)
    longest = float(np.linalg.norm(np.diff(mesh.V[edges(mesh.F).E], axis=1), axis=2).max())
    fine = refine_atlas(atlas, finer * longest)
    V, F = refine_long_edges(mesh.V, mesh.F, finer * longest)
    np.testing.assert_array_equal(fine.mesh.V, V)
    np.testing.assert_array_equal(fine.mesh.F, F)
    assert type(fine) is type(atlas)
    middle = V[F].mean(1)  # each in one face of the old mesh, the nearest to it
    parent = igl.point_mesh_squared_distance(middle, mesh.V, mesh.F)[1]
    bary = barycentric(mesh.V, mesh.F, parent, middle)
    np.testing.assert_allclose(
        fine.uv[fine.F_uv].mean(1), interpolate(atlas.uv, atlas.F_uv, parent, bary), atol=1e-6
    )
    np.testing.assert_array_equal(fine.chart_of_face, atlas.chart_of_face[parent])
    before, after = atlas_distortion(atlas), atlas_distortion(fine)
    assert after.flips == before.flips == 0
    assert (after.n_charts, after.overlaps) == (before.n_charts, before.overlaps)
    assert after.seam_over_sqrt_area == pytest.approx(before.seam_over_sqrt_area)


def test_an_atlas_of_short_edges_is_left_alone():
    atlas = build_atlas(Mesh(*sphere(500)))
    fine = refine_atlas(atlas, 1000.0)
    assert fine.mesh.V is atlas.mesh.V
    assert fine.uv is atlas.uv
