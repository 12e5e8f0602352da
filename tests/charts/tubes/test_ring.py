"""A ring's map repeats after its girth, and is isometric where it can be."""

import numpy as np
import pytest

from meshjig.charts.tubes.harmonic_function import two_ends
from meshjig.charts.tubes.ring import corner_uv, flatten_ring
from meshjig.charts.tubes.separating_loops import across
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.mesh.mesh import Mesh
from tests.charts.helpers import all_turn_left
from tests.charts.revolved import bent, holed, pole, trumpet

GIRTH = 60 * 2 * 15 * np.sin(np.pi / 60)  # of the pole's polygon


def mapped(V, F):
    left = across(V, F, two_ends(Mesh(V, F)))
    ring = flatten_ring(V, F, left)
    return ring, *corner_uv(F, ring.uv, left, ring.period)


@pytest.mark.parametrize(
    "mesh",
    [pole(), pole(turn=0.4), holed(pole(turn=0.4), pole()[0][20 * 60], 6.0)],
    ids=["grid", "twisted", "holed"],
)
def test_a_straight_tube_is_mapped_isometrically(mesh):
    ring, uv, corners = mapped(*mesh)
    assert ring.period == pytest.approx(GIRTH, rel=2e-3)
    np.testing.assert_allclose(singular_values(*mesh, uv, corners), 1, atol=5e-3)


@pytest.mark.parametrize("mesh", [pole(), trumpet(), bent(trumpet(), 130.0)], ids=["pole", "trumpet", "horn"])
def test_v_grows_along_the_tube_and_no_face_is_mirrored(mesh):
    ring, uv, corners = mapped(*mesh)
    assert ring.period > 0
    assert all_turn_left(uv, corners)
    first, last = two_ends(Mesh(*mesh))
    assert ring.uv[first, 1].max() < ring.uv[last, 1].min()


@pytest.mark.parametrize("mesh", [trumpet(), bent(pole(), 130.0)], ids=["trumpet", "elbow"])
def test_the_mean_stretch_is_1_and_all_of_it_within_limits(mesh):
    _, uv, corners = mapped(*mesh)
    stretch = singular_values(*mesh, uv, corners)
    area = face_areas(*mesh)
    assert np.average(np.log(stretch).sum(1), weights=area) == pytest.approx(0, abs=1e-6)
    assert stretch.min() > 0.8
    assert stretch.max() < 1.25


def test_the_period_of_a_widening_tube_lies_between_its_girths():
    ring, _, _ = mapped(*trumpet())
    assert 2 * np.pi * 15.3 < ring.period < 2 * np.pi * 18
