import numpy as np
import pytest

from meshjig.charts.flatten.embeddings import lscm, tutte
from meshjig.charts.flatten.isometry import arap, slim
from meshjig.mesh.measure import face_areas, singular_values
from tests.charts.helpers import all_turn_left, half_tube
from tests.meshes import half_sphere, open_cup, saddle


def test_a_developable_chart_comes_out_isometric():
    V, F = half_tube()
    bent = lscm(V, F) * [1.2, 0.9]
    np.testing.assert_allclose(singular_values(V, F, arap(V, F, bent, 200)), 1, atol=5e-3)


def test_stretch_evens_out_where_angles_alone_were_kept():
    chart = half_sphere(1000)
    before = lscm(*chart)
    after = arap(*chart, before)
    spread = [np.ptp(singular_values(*chart, uv).prod(1)) for uv in (before, after)]
    assert spread[1] < 0.6 * spread[0]


def excess_energy(chart, uv):
    """Give the symmetric Dirichlet energy over that of an isometry."""
    s = singular_values(chart[0], chart[1], uv)
    return (face_areas(*chart) * ((s**2 + 1 / s**2).sum(1) - 4)).sum()


@pytest.mark.parametrize("chart", [half_sphere(800), saddle(800), open_cup(1000)])
def test_energy_falls_and_no_face_is_mirrored(chart):
    start = tutte(*chart)
    uv = slim(*chart, start, 10)
    assert all_turn_left(uv, chart.F)
    assert excess_energy(chart, uv) < 0.6 * excess_energy(chart, start)


def test_a_developable_chart_comes_out_isometric_by_slim():
    V, F = half_tube()
    np.testing.assert_allclose(singular_values(V, F, slim(V, F, tutte(V, F), 60)), 1, atol=1e-3)
