"""Hanging vertices are joined: the edges that they lie on are split, and nothing else."""

import numpy as np
import pytest

from meshjig.mesh.boundary_loops import border_loops
from meshjig.mesh.components import components
from meshjig.mesh.measure import face_areas, mesh_volume
from meshjig.scan import repair
from meshjig.scan.hanging import join_hanging
from tests.meshes import Shape, half_sphere, sphere, torus


def halves(fine, coarse):
    """A sphere of flat faces, whose upper half is split into four times as many in the same planes."""
    mesh = sphere(320)
    upper = mesh.V[mesh.F].mean(1)[:, 2] > 0
    corners = mesh.V[mesh.F]
    up, down = corners[upper], corners[~upper]
    for _ in range(fine):
        up = quartered(up)
    for _ in range(coarse):
        down = quartered(down)
    soup = np.concatenate([up, down]).astype(np.float32).astype(np.float64)
    return Shape(soup.reshape(-1, 3), np.arange(3 * len(soup)).reshape(-1, 3)), mesh


def quartered(corners):
    a, b, c = corners.transpose(1, 0, 2)
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([np.stack(part, 1) for part in parts])


@pytest.mark.parametrize(("fine", "coarse"), [(1, 0), (2, 0), (0, 1), (3, 1)])
def test_a_fine_and_a_coarse_half_become_one_closed_surface(fine, coarse):
    soup, mesh = halves(fine, coarse)
    V, F, changes = repair(*soup)
    assert (components(F)[0], border_loops(F), changes.dropped_components) == (1, [], 0)
    assert changes.hanging_vertices > 0
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*mesh), rel=1e-5)


def test_several_vertices_on_all_three_edges_of_a_face():
    triangle = np.array([[0.0, 0, 0], [6, 0, 0], [0, 6, 0]])
    rim = [[0, 0, 0], [1, 0, 0], [4, 0, 0], [6, 0, 0], [4, 2, 0], [2, 4, 0], [0, 6, 0], [0, 3, 0]]
    V = np.concatenate([triangle, rim[1:3], rim[4:6], rim[7:], [[1, 1, -3]]])
    around = [0, 3, 4, 1, 5, 6, 2, 7]
    cone = [[b, a, 8] for a, b in zip(around, around[1:] + around[:1], strict=True)]
    F, joined = join_hanging(V, np.array([[0, 1, 2], *cone]), 1e-6)
    assert joined == 5
    assert not border_loops(F)
    assert len(F) == 8 + 6
    assert face_areas(V, F).sum() == pytest.approx(face_areas(V, np.array([[0, 1, 2], *cone])).sum())


@pytest.mark.parametrize("shape", [sphere(300), torus(300), half_sphere(300)])
def test_a_mesh_without_hanging_vertices_stays_as_it_is(shape):
    F, joined = join_hanging(shape.V, shape.F, 1e-4)
    assert joined == 0
    assert np.array_equal(F, shape.F)
