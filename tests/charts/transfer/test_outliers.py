import numpy as np
import pytest

from meshjig.charts.transfer.outliers import without_strays
from tests.meshes import disc, half_sphere, noisy


@pytest.mark.parametrize("mesh", [disc(1500), half_sphere(1500), noisy(disc(1500), 0.3)])
def test_strays_come_back_and_all_others_stay(mesh):
    V, F = mesh
    flat = V[:, :2].copy()
    near = np.linalg.norm(V - V[200], axis=1) < 6
    thrown = flat.copy()
    thrown[near] += [60.0, 15.0]
    back = without_strays(V, F, thrown)
    assert near.sum() >= 5
    np.testing.assert_array_equal(back[~near], flat[~near])
    assert np.linalg.norm(back[near] - flat[near], axis=1).max() < 6


def test_nothing_astray_is_nothing_changed():
    V, F = noisy(disc(1500), 0.3)
    np.testing.assert_array_equal(without_strays(V, F, V[:, :2]), V[:, :2])
