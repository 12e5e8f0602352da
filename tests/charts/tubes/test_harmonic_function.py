"""The ends of a tube are its open rims, or its tips; holes are none."""

import numpy as np
import pytest

from meshjig.charts.tubes.harmonic_function import girths, harmonic_function, transferred_ends, two_ends
from meshjig.errors import ChartError
from meshjig.mesh.boundary_loops import borders_by_length
from meshjig.mesh.measure import face_areas
from meshjig.mesh.mesh import Mesh
from tests.charts.revolved import bent, cone, holed, limb, pole, vase
from tests.meshes import torus


@pytest.mark.parametrize(("mesh", "low", "high"), [(pole(), 0, 90), (cone(), 0, 100)])
def test_open_tubes_end_at_their_rims_the_lower_first(mesh, low, high):
    ends = two_ends(Mesh(*mesh))
    np.testing.assert_array_equal(mesh[0][ends.first, 1], low)
    np.testing.assert_array_equal(mesh[0][ends.last, 1], high)
    assert len(ends.first) == len(ends.last) == 60


def test_a_vase_ends_at_the_middle_of_its_bottom_and_at_its_rim():
    V, F = vase()
    ends = two_ends(Mesh(V, F))
    np.testing.assert_allclose(V[ends.first], [[0, 0, 0]], atol=1e-9)
    np.testing.assert_array_equal(V[ends.last, 1], 110)


def test_closed_limbs_end_at_their_tips():
    V, F = limb()
    ends = two_ends(Mesh(V, F))
    first_ring = 4.0  # mm from the axis
    np.testing.assert_allclose(V[ends.first][0], [0, 0, 0], atol=first_ring)
    np.testing.assert_allclose(V[ends.last][0], [0, 120, 0], atol=first_ring)


@pytest.mark.parametrize("mesh", [pole(), vase()])
def test_a_hole_in_the_wall_is_no_end(mesh):
    V, F = holed(mesh, mesh[0][20 * 60], 5.0)
    assert len(borders_by_length(F)) == len(borders_by_length(mesh[1])) + 1
    ends = two_ends(Mesh(V, F))
    for found, expected in zip(ends, two_ends(Mesh(*mesh)), strict=True):
        np.testing.assert_allclose(V[found].mean(0), mesh[0][expected].mean(0), atol=1e-9)


def test_handles_are_refused():
    with pytest.raises(ChartError, match="handles"):
        two_ends(Mesh(*torus(600)))


def test_rims_run_along_the_border_in_order():
    V, F = bent(pole())
    for rim in borders_by_length(F):
        assert len(rim) == 60
        step = np.linalg.norm(V[rim] - V[np.roll(rim, -1)], axis=1)
        assert step.max() < 2.5


def test_ends_of_a_proxy_are_found_on_the_mesh():
    V, F = vase()
    some = V[::3]
    low, high = V[:, 1].argmin(), np.flatnonzero(V[:, 1] == 110)
    light = type(two_ends(Mesh(V, F)))(
        np.array([np.linalg.norm(some - V[low], axis=1).argmin()]), np.flatnonzero(some[:, 1] == 110)
    )
    ends = transferred_ends(V, F, some, light)
    assert set(ends.last.tolist()) == set(high.tolist())
    assert V[ends.first[0], 1] == 0


def test_height_on_a_straight_tube_is_its_own():
    V, F = pole(turn=0.5)
    height = harmonic_function(V, F, two_ends(Mesh(V, F)))
    np.testing.assert_allclose(height, V[:, 1] / 90, atol=1e-6)


@pytest.mark.parametrize("mesh", [vase(), limb(), cone(), bent(pole())])
def test_heights_have_no_peak_between_the_ends(mesh):
    V, F = mesh
    ends = two_ends(Mesh(V, F))
    height = harmonic_function(V, F, ends)
    highest, lowest = np.full(len(V), -np.inf), np.full(len(V), np.inf)
    for k in (1, 2):
        np.maximum.at(highest, F.ravel(), height[np.roll(F, k, 1).ravel()])
        np.minimum.at(lowest, F.ravel(), height[np.roll(F, k, 1).ravel()])
    inner = np.setdiff1d(np.arange(len(V)), np.concatenate(ends))
    assert (highest[inner] > height[inner]).all()
    assert (lowest[inner] < height[inner]).all()


def test_slices_of_a_cone_have_its_girths():
    V, F = cone()
    slices = girths(V, F, harmonic_function(V, F, two_ends(Mesh(V, F))))
    assert slices.area.sum() == pytest.approx(face_areas(V, F).sum())
    slant = np.hypot(21, 100)
    middle = (slices.along[1:] + slices.along[:-1]) / 2
    assert slices.along[-1] == pytest.approx(slant, rel=0.01)
    np.testing.assert_allclose(slices.girth, 2 * np.pi * (30 - 21 * middle / slant), rtol=0.03)
