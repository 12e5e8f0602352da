"""Crossings are found where two surfaces were pushed through each other, and nowhere else."""

import numpy as np
import pytest
from hypothesis import given, settings

from meshjig.scan import self_crossings
from tests.meshes import (
    Shape,
    cavity_shell,
    creased_box,
    disc,
    genus2,
    half_sphere,
    joined,
    moved,
    open_cup,
    sphere,
    torus,
)
from tests.strategies import meshes


def pierced(mesh):
    """Give pairs of faces without a common corner that an edge of one joins to the other, by brute force."""
    V, F = mesh
    pairs = set()
    for k in range(3):
        p, q = V[F[:, k]], V[F[:, (k + 1) % 3]]
        for j, (a, b, c) in enumerate(V[F]):
            n = np.cross(b - a, c - a)
            s, t = (p - a) @ n, (q - a) @ n
            crossing = np.flatnonzero(s * t < 0)
            x = p[crossing] + (s / (s - t + (s == t)))[crossing, None] * (q - p)[crossing]
            inside = np.all([np.cross(v - u, x - u) @ n > 0 for u, v in ((a, b), (b, c), (c, a))], axis=0)
            pairs |= {(min(i, j), max(i, j)) for i in crossing[inside].tolist()}
    return {(i, j) for i, j in pairs if not set(F[i]) & set(F[j])}


@given(meshes(faces=(100, 1000), noise=0.05))
@settings(max_examples=25, deadline=None)
def test_an_embedded_surface_does_not_cross_itself(mesh):
    assert len(self_crossings(*mesh)) == 0


@pytest.mark.parametrize(
    "mesh",
    [
        joined(sphere(200), moved(torus(200), [30.3, 11.1, 7.7])),
        joined(half_sphere(200), moved(open_cup(200), [3.3, 1.1, 17.7])),
        joined(creased_box(150), moved(genus2(150), [33.3, 27.1, 37.7])),
    ],
)
def test_pairs_are_those_that_brute_force_finds(mesh):
    pairs = self_crossings(*mesh)
    assert {tuple(pair) for pair in pairs.tolist()} == pierced(mesh)
    assert len(pairs) > 20


def test_a_fold_of_neighbours_is_a_crossing():
    V, F = half_sphere(600)
    V = V.copy()
    V[0] = [60, 3, 20]  # the top is pulled through the side
    found = {tuple(pair) for pair in self_crossings(V, F).tolist()}
    assert found >= pierced(Shape(V, F))
    assert len(found) > 10


def test_coplanar_overlap_is_a_crossing():
    sheet = disc(200)
    assert len(self_crossings(*joined(sheet, moved(sheet, [3.3, 1.1, 0])))) > 200
    assert len(self_crossings(*joined(sheet, moved(sheet, [3.3, 1.1, 0.01])))) == 0


def test_touching_and_nesting_are_no_crossings():
    box = creased_box(300)
    assert len(self_crossings(*joined(box, moved(box, [100, 100, 0])))) == 0
    assert len(self_crossings(*cavity_shell(600))) == 0


def test_what_native_code_could_not_survive_is_not_tried():
    V, F = sphere(100)
    assert self_crossings(V, F + 10**6) is None
    assert self_crossings(V * np.nan, F) is None
    assert len(self_crossings(V, F[:0])) == 0
