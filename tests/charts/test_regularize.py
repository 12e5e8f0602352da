import numpy as np
import pytest

from meshjig.charts.regularize import steady
from meshjig.errors import ChartError
from meshjig.mesh.measure import face_areas
from tests.meshes import noisy, sphere


def test_steady_moves_thin_faces_only_and_by_little():
    V, F = sphere(500)
    assert steady(V, F) is V
    V[F[100, 0]] = V[F[100, 1]]
    moved = steady(V, F)
    assert face_areas(moved, F).min() > 0
    shift = np.linalg.norm(moved - V, axis=1)
    thin = np.unique(F[face_areas(V, F) == 0])
    assert set(np.flatnonzero(shift)) == set(thin)
    assert shift.max() < 0.1
    with pytest.raises(ChartError, match="no extent"):
        steady(np.zeros_like(V), F)


def test_noise_is_smoothed_away_on_top_of_that():
    V, F = noisy(sphere(20000), 0.25)
    assert np.linalg.norm(steady(V, F), axis=1).std() < 0.4 * np.linalg.norm(V, axis=1).std()
