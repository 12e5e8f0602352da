"""Holes are closed where they are small, smoothly, and nowhere else."""

import numpy as np
import pytest

from meshjig.mesh.halfedges import border_halfedges, compact
from meshjig.mesh.measure import mesh_volume
from meshjig.scan.fill import fill_holes
from meshjig.scan.manifold import is_clean
from tests.meshes import sphere, torus


def pierced(V, F, where, radius):
    """Take away the faces with a corner within radius of a place."""
    gone = (np.linalg.norm(V[F] - where, axis=2) < radius).any(1)
    G, kept = compact(F[~gone])
    return V[kept], G


@pytest.mark.parametrize("radius", [0.1, 0.25, 0.5])
def test_a_hole_in_a_sphere_is_closed_to_the_sphere(radius):
    V, F = sphere()
    V = V / np.linalg.norm(V, axis=1)[:, None]
    W, G = pierced(V, F, V[0], radius)
    filled = fill_holes(W, G, 4 * radius)
    assert filled.facts.closed == 1
    assert filled.facts.left == 0
    assert is_clean(filled.F, len(filled.V))
    assert mesh_volume(filled.V, filled.F) == pytest.approx(mesh_volume(V, F), rel=0.01)
    assert np.abs(np.linalg.norm(filled.V, axis=1) - 1).max() < 0.15 * radius


def test_the_given_vertices_and_faces_come_first():
    W, G = pierced(*sphere(), sphere()[0][0], 0.3 * np.abs(sphere()[0]).max())
    filled = fill_holes(W, G, 1e3)
    assert np.array_equal(filled.V[: len(W)], W)
    assert np.array_equal(filled.F[: len(G)], G)


def test_a_wider_hole_stays_open():
    V, F = torus()
    extent = np.ptp(V, axis=0).max()
    W, G = pierced(V, F, V[0], 0.04 * extent)
    W, G = pierced(W, G, V[np.argmax(np.linalg.norm(V - V[0], axis=1))], 0.15 * extent)
    filled = fill_holes(W, G, 0.2 * extent)
    assert (filled.facts.closed, filled.facts.left) == (1, 1)
    assert len(border_halfedges(filled.F)) > 0


def test_the_border_of_a_scrap_is_no_hole():
    V, F = sphere()
    kept = np.linalg.norm(V[F].mean(1) - V[0], axis=1) < 0.3 * np.abs(V).max()
    G, used = compact(F[kept])
    filled = fill_holes(V[used], G, 1e3)
    assert filled.facts.closed == 0
    assert np.array_equal(filled.F, G)
