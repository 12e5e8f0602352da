import numpy as np
import pytest

from meshjig.mesh.measure import unit
from meshjig.solid.local_thickness import inward_room, thin_share
from tests.meshes import creased_box, disc, sphere


def test_room_in_a_ball_is_nearly_its_radius():
    V, F = sphere(4000)
    room = inward_room(V, F, unit(V))
    assert room.max() <= 45.0 + 1e-6
    assert room.min() > 0.45 * 2 * 50 * np.cos(np.deg2rad(35)) ** 2 - 0.5  # a tilted chord


def test_room_in_a_plate_is_045_of_its_height():
    V, F = creased_box(5000)
    V = V * np.array([1, 1, 0.08])  # 8 mm high
    flat = np.abs(V[:, :2]).max(1) < 35
    d = np.where(flat[:, None], np.sign(V) * np.array([0, 0, 1]), unit(V))
    assert inward_room(V, F, d)[flat] == pytest.approx(np.full(flat.sum(), 0.45 * 8), abs=2e-3)


def test_an_open_sheet_has_all_the_room():
    V, F = disc(500)
    assert np.isinf(inward_room(V, F, np.tile([0.0, 0.0, 1.0], (len(V), 1)))).all()


def test_thin_share_is_by_area():
    V, F = disc(2400)
    assert thin_share(V, F, V[:, 0] > 0) == pytest.approx(0.5, abs=0.03)
    assert thin_share(V, F, np.linalg.norm(V, axis=1) < 25) == pytest.approx(0.25, abs=0.03)
