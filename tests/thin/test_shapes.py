"""The made shapes are what they are to be: closed, even, and as thin as they say."""

import numpy as np
import pytest

from meshjig.mesh.measure import corner_angles, edge_lengths, mesh_volume
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.ray_thickness import ray_thickness
from meshjig.scan import self_crossings
from tests.thin.shapes import (
    SHAPES,
    cup,
    ear,
    hand,
    hem,
    mask,
    plate,
    rod_on_ball,
    thin_torus,
    two_plates,
)

HOLES = {mask: 2, thin_torus: 1}


@pytest.mark.parametrize("shape", SHAPES)
def test_a_shape_is_one_closed_solid(shape):
    mesh = Mesh(*shape())
    V, F = mesh
    assert (mesh.edges.n_faces == 2).all()
    assert (mesh.edges.twin != np.arange(3 * len(F))).all()  # oriented
    assert mesh.n_components == 1
    assert len(V) - len(mesh.edges.E) + len(F) == 2 - 2 * HOLES.get(shape, 0)
    assert len(np.unique(F)) == len(V)
    assert len(self_crossings(V, F)) == 0
    assert mesh_volume(V, F) > 0


@pytest.mark.parametrize("shape", SHAPES)
def test_a_shape_is_evenly_meshed(shape):
    mesh = Mesh(*shape())
    assert 4000 < len(mesh.F) < 17_000
    length = edge_lengths(mesh.V, mesh.edges.E)
    assert 0.8 < np.median(length) < 2.4
    assert np.percentile(length, 99) < 2 * np.median(length)
    assert np.percentile(corner_angles(mesh.V, mesh.F).min(axis=1), 1) > np.radians(25)


def below(shape, where, most=np.inf):
    """Measure the thickness below the faces whose middles are in some place."""
    mesh = Mesh(*shape())
    here = where(*mesh.V[mesh.F].mean(axis=1).T)
    assert here.sum() > 20
    return ray_thickness(mesh, most).depth[here]


@pytest.mark.parametrize(
    ("shape", "where", "thick"),
    [
        (plate, lambda x, y, z: (abs(x) < 38) & (abs(y) < 28), (2.95, 3.05)),
        (rod_on_ball, lambda x, y, z: (z > 35) & (z < 66), (3.3, 4.05)),  # tilted rays are chords
        (cup, lambda x, y, z: (z > 8) & (z < 58), (2.45, 2.55)),
        (cup, lambda x, y, z: np.hypot(x, y) < 22, (2.45, 2.55)),
        (mask, lambda x, y, z: (z > 4) & (y > 16), (2.2, 2.6)),
        (ear, lambda x, y, z: (z > 26) & (z < 28) & (abs(x) < 5), (2.0, 2.8)),
        (ear, lambda x, y, z: (z > 6) & (z < 8) & (abs(x) < 5), (6.5, 8.5)),
        (hand, lambda x, y, z: (y > 58) & (y < 60), (3.3, 4.6)),
        (hand, lambda x, y, z: (abs(x) < 12) & (abs(y) < 10), (17.9, 18.1)),
        (thin_torus, lambda x, y, z: abs(z) < 9, (3.3, 4.05)),
        (two_plates, lambda x, y, z: (x > -8) & (x < 18) & (abs(y) < 13), (2.95, 3.05)),
        (hem, lambda x, y, z: (x > 16) & (x < 35) & (abs(y) < 13), (2.95, 3.05)),
    ],
)
def test_a_shape_is_as_thick_as_it_says(shape, where, thick):
    depth = below(shape, where)
    assert thick[0] < np.percentile(depth, 2)
    assert np.percentile(depth, 98) < thick[1]


def test_the_ear_thins_out_to_a_millimetre():
    depth = below(ear, lambda x, y, z: (z > 30.5) & (abs(x) < 2))
    assert 0.9 < depth.min() < 1.4


@pytest.mark.parametrize(("shape", "apart"), [(two_plates, 1.0), (hem, 2.0)])
def test_sheets_side_by_side_are_as_far_apart_as_they_say(shape, apart):
    V, F = shape()
    outside = Mesh(V, F[:, ::-1].copy())  # rays go through the air
    centre = V[F].mean(axis=1)
    here = (centre[:, 0] > 15) & (centre[:, 0] < 17) & (abs(centre[:, 1]) < 10)
    depth = ray_thickness(outside, 10.0).depth[here]
    assert depth[np.isfinite(depth)].mean() == pytest.approx(apart, abs=0.05)
    assert np.isfinite(depth).sum() > 20
