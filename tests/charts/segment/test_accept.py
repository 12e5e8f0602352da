import numpy as np
import pytest

from meshjig.charts.segment.accept import ConformalDistortion
from tests.charts.helpers import half_tube
from tests.meshes import half_sphere, saddle


def test_a_developable_surface_has_none():
    V, F = half_tube()
    assert ConformalDistortion(V, F).spread(np.arange(len(F))) < 1e-9


def test_a_cap_has_that_of_its_stereographic_map():
    V, F = half_sphere(6000)
    # From the pole to the polar angle a, the scale of the map from the other pole falls by cos^2(a / 2).
    expected = np.log(1 / np.cos(np.pi / 4) ** 2)
    assert ConformalDistortion(V, F).spread(np.arange(len(F))) == pytest.approx(expected, rel=0.03)


def test_a_larger_part_of_a_bowl_has_more():
    V, F = saddle(3000)
    reach = np.linalg.norm(V[F].mean(1)[:, :2], axis=1)
    spreads = [ConformalDistortion(V, F).spread(np.flatnonzero(reach < r)) for r in (10, 25, 45)]
    assert 0 < spreads[0] < spreads[1] < spreads[2]
