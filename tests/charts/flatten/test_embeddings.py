import numpy as np
import pytest

from meshjig.charts.flatten.embeddings import lscm, tutte
from meshjig.errors import ChartError
from meshjig.mesh.measure import face_areas
from tests.charts.helpers import all_turn_left, corner_angles, half_tube, signed_areas
from tests.meshes import half_sphere, noisy, open_cup, saddle, sphere


@pytest.mark.parametrize(
    ("chart", "degrees"), [(half_sphere(2000), 2), (saddle(2000), 2), (noisy(half_sphere(2000), 0.05), 8)]
)
def test_angles_and_area_survive(chart, degrees):
    uv = lscm(*chart)
    assert all_turn_left(uv, chart.F)
    off = np.abs(corner_angles(uv, chart.F) - corner_angles(chart.V, chart.F))
    assert np.quantile(off, 0.95) < degrees
    assert signed_areas(uv, chart.F).sum() == pytest.approx(face_areas(*chart).sum())


def test_a_developable_chart_keeps_its_lengths():
    V, F = half_tube()
    uv = lscm(V, F)
    E = F[:, [0, 1]]
    np.testing.assert_allclose(
        np.linalg.norm(uv[E[:, 0]] - uv[E[:, 1]], axis=1),
        np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1),
        rtol=1e-6,
    )


def test_a_closed_surface_is_refused():
    with pytest.raises(ChartError, match="border"):
        lscm(*sphere(100))


def test_a_chart_without_extent_is_refused():
    V, F = half_sphere(100)
    with pytest.raises(ChartError, match="single point"):
        lscm(np.zeros_like(V), F)


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
