import numpy as np

from meshjig.charts.flatten.arap import arap
from meshjig.charts.flatten.lscm import lscm
from meshjig.mesh.measure import singular_values
from tests.charts.helpers import half_tube
from tests.meshes import half_sphere


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
