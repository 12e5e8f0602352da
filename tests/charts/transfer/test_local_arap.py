import numpy as np
import pytest

from meshjig.charts.distortion import flat_share
from meshjig.charts.transfer.local_arap import local_arap
from meshjig.mesh.halfedges import border_halfedges
from tests.charts.helpers import all_turn_left
from tests.meshes import disc, half_sphere


def bumpy(height):
    """A flat disc with bumps of 10 mm that its own plane knows nothing of."""
    V, F = disc(12000)
    uv = np.ascontiguousarray(V[:, :2])
    V = V.copy()
    V[:, 2] = height * (np.sin(V[:, 0] / 3.2) * np.sin(V[:, 1] / 3.2)).clip(0.0)
    return V, F, uv


@pytest.mark.parametrize("height", [3.0, 4.0])
def test_bumps_get_the_room_that_they_need(height):
    V, F, uv = bumpy(height)
    settled = local_arap(V, F, uv)
    assert 1 - flat_share(V, F, settled) < 0.6 * (1 - flat_share(V, F, uv))
    assert all_turn_left(settled, F)
    rim = F.ravel()[border_halfedges(F)]
    assert (settled[rim] == uv[rim]).all()


def test_a_map_without_stretch_stays_as_it_is():
    V, F = disc(3000)
    uv = np.ascontiguousarray(V[:, :2])
    assert local_arap(V, F, uv) is uv


def test_far_from_stretch_nothing_moves():
    V, F = disc(12000)
    uv = V[:, :2].copy()
    V = V.copy()
    V[:, 2] = 6 * np.exp(-((V[:, 0] - 25) ** 2 + V[:, 1] ** 2) / 20)
    settled = local_arap(V, F, uv)
    assert (settled != uv).any()
    assert (settled[V[:, 0] < 0] == uv[V[:, 0] < 0]).all()


def test_mirrored_faces_are_left_to_untangle():
    V, F = half_sphere(600)
    uv = V[:, :2].copy()
    uv[0] = [200.0, 0.0]
    assert local_arap(V, F, uv) is uv
