"""Rays meet the faces that are in their way."""

import numpy as np
import pytest

from meshjig.mesh.rays import RayScene
from tests.meshes import sphere

V, F = sphere(2000)
OUT = np.array([[0.0, 0, 0], [0.0, 0, 300], [200.0, 0, 0]])
UP = np.array([[0.0, 0, 1], [0.0, 0, 1], [0.0, 0, 1]])


@pytest.mark.parametrize("robust", [False, True])
def test_a_ray_from_the_middle_meets_the_sphere_and_one_from_outside_does_not(robust):
    scene = RayScene(V, F, robust)
    face = scene.first_face(OUT, UP)
    assert (face[0] >= 0, face[1], face[2]) == (True, -1, -1)
    assert V[F[face[0]]].mean(axis=0)[2] > 40
    assert scene.first_distance(OUT, UP)[0] == pytest.approx(50, abs=0.5)
    found = scene.hits(OUT, UP)
    assert found["primID"][0] == face[0]
    assert found["tfar"][0] == pytest.approx(50, abs=0.5)


def test_a_ray_goes_as_far_as_it_may():
    scene = RayScene(V, F)
    origin, up = OUT[[0, 0]], UP[[0, 0]]
    assert (scene.first_face(origin, up, np.array([10.0, 100.0])) >= 0).tolist() == [False, True]
    assert scene.is_hidden(origin, up, np.array([10.0, 100.0])).tolist() == [False, True]
