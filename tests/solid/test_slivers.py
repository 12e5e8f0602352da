"""Needles are flipped away; what is left is as closed, and the same shape."""

import numpy as np
import pytest

from meshjig.check.self_intersection import self_intersections
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, mesh_volume
from meshjig.solid.slivers import without_needles
from tests.meshes import creased_box, genus2, sphere

LEAST = 1e-4


def with_needles(V, F, every=7, height=1e-6):
    """Put a new corner all but on one side of some faces: both faces there become a pair, one a needle."""
    chosen = np.arange(0, len(F), every)
    a, b, c = F[chosen].T
    middle = V[a] + 0.4 * (V[b] - V[a])
    new = middle + height * (V[c] - middle)
    k = len(V) + np.arange(len(chosen))
    rest = np.delete(F, chosen, axis=0)
    split = [np.stack(corners, 1) for corners in ((a, b, k), (b, c, k), (c, a, k))]
    return np.concatenate([V, new]), np.concatenate([rest, *split])


def heights(V, F):
    side = np.linalg.norm(V[np.roll(F, -1, axis=1)] - V[F], axis=2).max(1)
    return np.linalg.norm(area_vectors(V, F), axis=1) / side


@pytest.mark.parametrize("shape", [sphere(600), genus2(900), creased_box(1200)])
def test_needles_go_and_the_shape_stays(shape):
    V, F = with_needles(*shape)
    assert (heights(V, F) < LEAST).sum() > 50
    G = without_needles(V, F, LEAST)
    assert (heights(V, G) > LEAST).all()
    e = edges(G)
    assert (e.n_faces == 2).all()
    assert len(e.E) == len(edges(F).E)
    assert set(G.ravel()) == set(F.ravel())
    assert mesh_volume(V, G) == pytest.approx(mesh_volume(V, F), rel=1e-6)


def test_faces_that_are_high_enough_stay_as_they_are():
    V, F = genus2(900)
    assert without_needles(V, F, LEAST) is F


def test_a_needle_that_is_turned_over_at_the_foot_of_a_wall_crosses_nothing_once_flipped():
    V = np.array([[0.0, 0, 0], [8, 0, 0], [4, 8, 0], [4, 2, 8], [3, 1e-6, -5e-7]])
    F = np.array([[0, 2, 1], [0, 1, 4], [0, 4, 3], [4, 1, 3], [1, 2, 3], [2, 0, 3]])
    assert len(self_intersections(V, F, depth=0.0)) > 0
    assert len(self_intersections(V, without_needles(V, F, LEAST), depth=0.0)) == 0
