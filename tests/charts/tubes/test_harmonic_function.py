"""Heights run evenly along a tube; slices know their area and their girth."""

import numpy as np
import pytest

from meshjig.charts.tubes.ends import two_ends
from meshjig.charts.tubes.harmonic_function import girths, harmonic_height
from meshjig.mesh.measure import face_areas
from tests.charts.revolved import bent, cone, limb, pole, vase


def test_height_on_a_straight_tube_is_its_own():
    V, F = pole(turn=0.5)
    height = harmonic_height(V, F, two_ends(V, F))
    np.testing.assert_allclose(height, V[:, 1] / 90, atol=1e-6)


@pytest.mark.parametrize("mesh", [vase(), limb(), cone(), bent(pole())])
def test_heights_have_no_peak_between_the_ends(mesh):
    V, F = mesh
    ends = two_ends(V, F)
    height = harmonic_height(V, F, ends)
    highest, lowest = np.full(len(V), -np.inf), np.full(len(V), np.inf)
    for k in (1, 2):
        np.maximum.at(highest, F.ravel(), height[np.roll(F, k, 1).ravel()])
        np.minimum.at(lowest, F.ravel(), height[np.roll(F, k, 1).ravel()])
    inner = np.setdiff1d(np.arange(len(V)), np.concatenate(ends))
    assert (highest[inner] > height[inner]).all()
    assert (lowest[inner] < height[inner]).all()


def test_slices_of_a_cone_have_its_girths():
    V, F = cone()
    slices = girths(V, F, harmonic_height(V, F, two_ends(V, F)))
    assert slices.area.sum() == pytest.approx(face_areas(V, F).sum())
    slant = np.hypot(21, 100)
    middle = (slices.way[1:] + slices.way[:-1]) / 2
    assert slices.way[-1] == pytest.approx(slant, rel=0.01)
    np.testing.assert_allclose(slices.girth, 2 * np.pi * (30 - 21 * middle / slant), rtol=0.03)
