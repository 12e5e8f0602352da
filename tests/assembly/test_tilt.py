"""How far walls must lean, where the angle is known."""

import numpy as np
import pytest

from meshjig.assembly import needed_tilt, room_to_lean
from meshjig.assembly.tilt import DIRECTIONS, FREE, around_sphere
from tests.assembly.sheets import ball, sheet

NORMAL = np.degrees(np.arccos(DIRECTIONS[:, 2]))


def free(borders):
    return np.full((len(borders.tail), 4), FREE)


def test_directions_are_spread_over_the_sphere_without_holes():
    some = np.random.default_rng(0).normal(size=(500, 3))
    some /= np.linalg.norm(some, axis=1)[:, None]
    assert np.linalg.norm(DIRECTIONS, axis=1) == pytest.approx(1)
    assert np.degrees(np.arccos((some @ DIRECTIONS.T).max(axis=1))).max() < 4
    assert np.abs(around_sphere(50).sum(axis=0)).max() < 1


def test_only_the_piece_that_moves_over_its_neighbour_needs_its_wall_to_lean():
    b = sheet(2, 1).borders
    left, right = needed_tilt(b, free(b))[:, 0]
    lean = np.degrees(np.arctan2(DIRECTIONS[:, 0], DIRECTIONS[:, 2]))
    over = (DIRECTIONS[:, 0] > 0) & (DIRECTIONS[:, 2] > 0)
    assert left[over] == pytest.approx(lean[over])
    assert (right[over] == 0).all()
    back = (DIRECTIONS[:, 0] < 0) & (DIRECTIONS[:, 2] > 0)
    assert (left[back] == 0).all()
    assert right[back] == pytest.approx(-lean[back])


def test_a_knob_s_walls_all_lean_along_the_way_whichever_piece_moves():
    b = sheet(2, 1, knob=True).borders
    both = needed_tilt(b, free(b))[:, 0]
    assert both[0] == pytest.approx(NORMAL)
    assert both[1] == pytest.approx(NORMAL)


def test_a_lean_counts_double_where_there_is_half_the_room():
    b = sheet(2, 1).borders
    assert needed_tilt(b, free(b) / 2) == pytest.approx(2 * needed_tilt(b, free(b)))


def test_pieces_of_a_sheet_need_no_tilt_along_its_normal():
    s = sheet()
    upright = NORMAL.argmin()
    assert s.need.shape == (2, 12, len(DIRECTIONS))
    assert s.need[:, :, upright].max() <= NORMAL[upright] + 1e-9


def test_walls_have_all_room_inside_a_plate_and_less_at_its_rim():
    s = sheet(2, 1, edge=5.0, step=0.5)
    b = s.borders
    room = room_to_lean(b, s.V, s.D, s.rays)
    y = (s.V[b.tail] + s.V[b.head])[:, 1] / 2
    assert (room[:, :2] == FREE).all()  # across the border, far from the rim
    inside = (y > 1.3) & (y < 3.7)
    assert (room[inside, 2:] == FREE).all()
    assert (room[y == 0.25, 2:] == 8).all()  # tan 15 degrees is 0.27
    assert (room[y == 0.75, 2:] == 33).all()  # tan 33 degrees is 0.65, of 41 it is 0.87


def test_on_a_ball_a_piece_goes_out_about_along_its_normal_with_less_tilt_than_askew():
    s = ball()
    for k in range(s.borders.n_pieces):
        mean = s.V[s.F[s.piece == k]].mean(axis=(0, 1))
        need = np.zeros(len(DIRECTIONS))
        for i, pair in enumerate(s.borders.pairs.tolist()):
            if k in pair:
                need = np.maximum(need, s.need[pair.index(k), i])
        off = np.degrees(np.arccos(DIRECTIONS @ mean / np.linalg.norm(mean)))
        assert off[need.argmin()] < 25
        assert need[off > 100].min() > 90
