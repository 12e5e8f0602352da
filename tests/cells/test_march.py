import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.cells.discs import shapes
from meshjig.cells.march import march
from meshjig.cells.power import PowerField
from meshjig.cells.surface import surface
from meshjig.mesh.components import is_disc
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Mesh
from tests.meshes import disc, torus


def in_plane(V, points):
    """The exact values of cells around points: squared distances."""
    value = ((V[:, None] - points) ** 2).sum(2)
    return PowerField(np.tile(np.arange(len(points)), (len(V), 1)), value)


def test_borders_lie_exactly_between_two_seeds_in_the_plane():
    s = surface(Mesh(*disc(3000)))
    points = np.array([[-20.0, 3, 0], [22, -7, 0]])
    field = in_plane(s.V, points)
    cut = march(s, field.owner, field)
    e = cut.mesh.edges
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    on = np.unique(e.E[e.edge_of_halfedge[h[cut.cell[h // 3] != cut.cell[e.twin[h] // 3]]]])
    off = np.abs(np.diff(np.linalg.norm(cut.mesh.V[on][:, None] - points, axis=2), axis=1))
    # edges are 2.2 mm: a border goes through a vertex that it passes close by
    assert off.max() / 2 < 0.08 * 2.2


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.integers(2, 12))
def test_cutting_keeps_the_surface_and_makes_no_sliver(seed, n):
    V, F = disc(400)
    s = surface(Mesh(V, F))
    points = np.random.default_rng(seed).uniform(-50, 50, (n, 3)) * [1, 1, 0]
    field = in_plane(V, points)
    cut = march(s, field.owner, field)
    assert (cut.mesh.V[: len(V)] == V).all()
    area = face_areas(cut.mesh.V[:, :2], cut.mesh.F)
    assert area.min() > 2e-4 * face_areas(V, F).min()  # 7e-4 was met, where three cells share a face
    assert np.bincount(cut.parent, area, len(F)) == pytest.approx(face_areas(V, F))
    assert edges(cut.mesh.F).n_faces.max() == 2
    assert (edges(cut.mesh.F).n_faces == 1).sum() >= (edges(F).n_faces == 1).sum()
    assert len(cut.mesh.V) - len(edges(cut.mesh.F).E) + len(cut.mesh.F) == 1


def test_shapes_agree_with_one_at_a_time():
    mesh = Mesh(*torus(2000))
    V, F = mesh
    middle = V[F].mean(1)
    ring = (middle[:, 0] > 20).astype(np.int64)
    quarter = np.where((middle[:, 0] > 0) & (middle[:, 1] > 0) & (middle[:, 2] > 0), 2, ring)
    for cell in (np.zeros(len(F), np.int64), ring, quarter):
        n = int(cell.max()) + 2  # the last one is empty
        found = shapes(mesh, cell, n)
        assert [bool(f == 1) for f in found] == [is_disc(F[cell == c]) for c in range(n)]
    assert shapes(mesh, np.zeros(len(F), np.int64), 1).tolist() == [0]  # a whole torus has Euler number 0
