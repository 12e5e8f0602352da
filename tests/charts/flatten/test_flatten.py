import numpy as np
import pytest

from meshjig.charts.distortion import border_is_simple, flat_share, is_unflipped, unit_stretch
from meshjig.charts.flatten.flatten import flatten
from meshjig.mesh.measure import face_areas, singular_values
from tests.charts.helpers import all_turn_left, half_tube
from tests.meshes import half_sphere, noisy, open_cup, saddle


@pytest.mark.parametrize("method", ["lscm", "arap", "slim"])
@pytest.mark.parametrize("chart", [half_sphere(800), saddle(800), open_cup(1000), noisy(open_cup(1000), 0.3)])
def test_every_method_keeps_every_face_the_right_way_up_at_a_mean_stretch_of_one(chart, method):
    uv = flatten(*chart, method)
    assert all_turn_left(uv, chart.F)
    log = np.log(singular_values(*chart, uv).prod(1)) / 2
    assert np.average(log, weights=face_areas(*chart)) == pytest.approx(0, abs=1e-9)


def test_flat_share_counts_area_by_both_stretches():
    V, F = half_tube()
    flat = flatten(V, F)
    assert flat_share(V, F, flat) == pytest.approx(1)
    assert flat_share(V, F, flat * [1.3, 1.0]) < 0.5
    assert flat_share(V, F, unit_stretch(V, F, 3 * flat)) == pytest.approx(1)


def test_a_spiral_that_runs_over_itself_is_unflipped_yet_not_simple():
    n = 200
    angle = np.linspace(0, 4 * np.pi, n)
    spiral = np.concatenate([r * np.stack([np.cos(angle), np.sin(angle)], 1) for r in (1.0, 2.0)])
    a = np.arange(n - 1)
    F = np.concatenate([np.stack([a, a + n, a + n + 1], 1), np.stack([a, a + n + 1, a + 1], 1)])
    assert is_unflipped(spiral, F)
    assert not border_is_simple(spiral, F)
    assert not is_unflipped(spiral[:, ::-1].copy(), F)
