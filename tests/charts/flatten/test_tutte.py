import numpy as np
import pytest

from meshjig.charts.flatten.tutte import tutte
from meshjig.mesh.measure import face_areas
from tests.charts.helpers import all_turn_left
from tests.meshes import half_sphere, noisy, open_cup, saddle


@pytest.mark.parametrize(
    "chart", [half_sphere(500), saddle(500), open_cup(1000), noisy(half_sphere(500), 1.0)]
)
def test_no_face_is_mirrored_and_the_border_is_round(chart):
    uv = tutte(*chart)
    assert all_turn_left(uv, chart.F)
    radius = np.linalg.norm(uv, axis=1)
    assert radius.max() == pytest.approx(np.sqrt(face_areas(*chart).sum() / np.pi))
    assert (radius > 0.999 * radius.max()).sum() >= 6


def test_border_points_that_fall_together_are_kept_apart():
    V = np.array([[0.0, 0, 0], [10, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0], [5, 5, 0]])
    F = np.array([[0, 1, 5], [1, 2, 5], [2, 3, 5], [3, 4, 5], [4, 0, 5]])
    assert all_turn_left(tutte(V, F), F)
