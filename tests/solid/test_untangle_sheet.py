import numpy as np
import pytest

from meshjig.mesh.measure import unit
from meshjig.solid.crossing_pairs import crossing_pairs
from meshjig.solid.untangle_sheet import flipped, untangle_sheet
from meshjig.solid.vertex_patches import VertexPatches
from tests.meshes import cylinder, noisy, sphere, torus, two_components

T = 2.0


def crossings(V, F, D):
    both = np.concatenate([F, F + len(V)])
    return len(crossing_pairs(np.concatenate([V, V + D]), both)[0])


@pytest.mark.parametrize(
    "mesh", [sphere(8000), torus(8000), two_components(8000)], ids=["sphere", "torus", "two"]
)
@pytest.mark.parametrize("disorder", [0.7, 1.5])
def test_a_crumpled_inner_sheet_is_unfolded(mesh, disorder):
    V, F = mesh
    D = -T * _normals(V, F)
    rng = np.random.default_rng(0)
    some = rng.choice(len(V), 40)
    D[some] += disorder * T * rng.normal(size=(40, 3))
    assert crossings(V, F, D) > 0
    D, facts = untangle_sheet(V, F, D, T)
    assert crossings(V, F, D) == 0
    assert facts.crossings_left == 0
    assert np.median(np.linalg.norm(D, axis=1)) == pytest.approx(T, abs=0.02)


def test_a_good_sheet_is_left_as_it_is():
    V, F = sphere(3000)
    D = -T * unit(V)
    after, facts = untangle_sheet(V, F, D, T)
    assert (after == D).all()
    assert facts.rounds == 0


def test_what_is_left_is_counted():
    V, F = noisy(sphere(1000), 1.5)  # the outer sheet itself is crumpled
    D, facts = untangle_sheet(V, F, -T * unit(V), T)
    assert np.isfinite(D).all()
    assert facts.folds_left >= facts.crossings_left
    assert facts.folds_left > 0


@pytest.mark.parametrize(("depth", "share"), [(20.0, 0.0), (40.0, 1.0)])
def test_flips_are_faces_that_passed_the_axis(depth, share):
    V, F = cylinder(1000)  # of radius 25
    assert flipped(V, F, -depth * unit(V * np.array([1, 1, 0]))).mean() == share


def test_smoothing_a_patch_holds_the_rest_and_keeps_constants():
    V, F = torus(2000)
    patches = VertexPatches(V, F)
    patch = patches.around(np.array([5]), 15.0)
    assert 20 < len(patch) < 300
    assert patches.smoothed(np.ones((len(V), 1)), 5.0, patch) == pytest.approx(np.ones((len(patch), 1)))
    spike = np.zeros((len(V), 1))
    spike[5] = 1.0
    low = patches.smoothed(spike, 5.0, patch)
    assert 0 < low.max() < 0.5
    assert low.min() >= -1e-4


def _normals(V, F):
    N = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    total = np.zeros_like(V)
    np.add.at(total, F.ravel(), np.repeat(N, 3, 0))
    return unit(total)
