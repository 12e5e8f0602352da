import numpy as np
import pytest

from meshjig.solid.crossing_pairs import crossing_pairs, near
from tests.meshes import joined, moved, sphere, torus


def test_two_triangles_cross_as_deep_as_one_reaches_through():
    V = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -3], [1.2, 1, 0.25], [1, 1.2, 0.25]], float)
    F = np.array([[0, 1, 2], [3, 4, 5]])
    pairs, depth = crossing_pairs(V, F)
    assert np.sort(pairs, 1).tolist() == [[0, 1]]
    assert depth == pytest.approx([0.25])


@pytest.mark.parametrize("mesh", [sphere(1000), torus(1000)], ids=["sphere", "torus"])
def test_embedded_surfaces_cross_nothing(mesh):
    assert len(crossing_pairs(*mesh)[0]) == 0


def test_touching_has_no_depth():
    V = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 0], [1, 1, 3], [2, 1, 3]], float)
    assert (crossing_pairs(V, np.array([[0, 1, 2], [3, 4, 5]]))[1] == 0).all()


@pytest.mark.parametrize("cell", [3.0, 20.0])
def test_near_faces_include_all_that_cross_an_active_one(cell):
    V, F = joined(sphere(1000), moved(sphere(600), [40, 10, 0]))
    pairs, _ = crossing_pairs(V, F)
    active = np.zeros(len(F), bool)
    active[pairs[::7, 0]] = True
    found = near(V, F, active, cell)
    assert found[pairs[active[pairs].any(1)]].all()
    assert len(pairs) > 50


def test_nothing_is_near_when_nothing_is_active():
    V, F = sphere(500)
    assert not near(V, F, np.zeros(len(F), bool), 5.0).any()
