"""Directions of walls: on the normal where they may be, along the way out where they must."""

import numpy as np
import pytest

from meshjig.assembly import Plan, peel, wall_directions
from meshjig.mesh.mesh import Mesh
from tests.assembly.sheets import THICK, ball, sheet

UP = np.array([0.0, 0.0, 1.0])


def leaning(degrees):
    """A direction over the right neighbour, so many degrees off the normal."""
    t = np.radians(degrees)
    return np.array([np.sin(t), 0, np.cos(t)])


def walls(s, plan, upright=None):
    upright = np.zeros(len(s.V), bool) if upright is None else upright
    return wall_directions(s.borders, plan, s.V, s.D, upright, s.rays)


def two(way, first):
    """A plan for two pieces: the other one goes out along a way."""
    return Plan(np.array([0, 1] if first == 0 else [1, 0]), np.array([way, way]), np.zeros(2))


def test_a_wall_leans_just_as_far_as_the_way_out_over_it_leans():
    s = sheet(2, 1)
    vertex, wall = walls(s, two(leaning(20), first=1))
    assert s.V[vertex, 0] == pytest.approx(10)
    expected = THICK * np.array([-np.tan(np.radians(20)), 0, -1])
    np.testing.assert_allclose(wall, np.tile(expected, (11, 1)), atol=1e-6)


def test_a_wall_stays_on_the_normal_where_the_way_leads_away_from_it():
    s = sheet(2, 1)
    for plan in (two(leaning(20), first=0), two(UP, first=1)):
        np.testing.assert_allclose(walls(s, plan)[1], np.tile([0, 0, -THICK], (11, 1)), atol=1e-9)


@pytest.mark.parametrize("first", [0, 1])
def test_the_walls_of_a_knob_are_along_the_way_out(first):
    s = sheet(2, 1, knob=True)
    way = np.array([0.1, 0.3, 0.9]) / np.linalg.norm([0.1, 0.3, 0.9])
    vertex, wall = walls(s, two(way, first))
    inside = (s.V[vertex, 1] > 2) & (s.V[vertex, 1] < 8)
    assert np.cross(wall[inside], way) == pytest.approx(0, abs=1e-6)
    assert wall[inside, 2] == pytest.approx(-THICK)


def test_walls_that_must_not_lean_are_not_named():
    s = sheet(2, 1)
    upright = s.V[:, 1] > 5
    vertex, _ = walls(s, two(leaning(20), first=1), upright)
    assert sorted(s.V[vertex, 1]) == [0, 1, 2, 3, 4, 5]


def test_no_wall_leans_farther_than_it_may():
    s = sheet(2, 1)
    _, wall = walls(s, two(leaning(80), first=1))
    lean = np.degrees(np.arctan2(np.linalg.norm(wall[:, :2], axis=1), -wall[:, 2]))
    assert lean.max() < 55.1


def test_on_a_ball_no_wall_is_in_the_way_of_the_piece_that_is_put_in_later():
    s = ball()
    b, plan = s.borders, peel(Mesh(s.V, s.F), s.piece, s.borders, s.need, UP)
    vertex, wall = walls(s, plan)
    W = np.zeros_like(s.V)
    W[vertex] = wall
    later = plan.later(b.side)
    way = plan.way[b.side[np.arange(len(later)), later]]
    away = np.where(later == 0, 1, -1)[:, None] * b.conormal  # out of the later piece
    assert set(vertex) == set(b.tail) | set(b.head)
    for end in (b.tail, b.head):
        outward = np.cross(b.tangent, W[end])
        outward *= np.sign(np.einsum("ij,ij->i", outward, away))[:, None]
        outward /= np.linalg.norm(outward, axis=1)[:, None]
        over = np.einsum("ij,ij->i", outward, way)
        assert over.max() < np.sin(np.radians(1.5))
        assert np.quantile(over, 0.99) < 0.01
