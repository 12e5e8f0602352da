"""What a solid meets on a straight way is known for boxes, tips and crossed edges."""

import numpy as np
import pytest
import trimesh

from meshjig.check.straight import Trials, across, met_on_the_way
from meshjig.mesh.mesh import Mesh, concatenate
from tests.check.jigsaws import GAP, TILE, coupon, dovetail
from tests.check.pieces import box, turned

UP, ASIDE = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def solid(shape):
    return Mesh(*shape)


def tip(at, direction, length=4.0):
    """Make a slim tetrahedron with its tip at a point; the rest lies against a direction."""
    x, y, z = across(np.array(direction, float))
    base = [np.cos(t) * x + np.sin(t) * y - length * z for t in (0.0, 2.1, 4.2)]
    hull = trimesh.convex.convex_hull(np.array([np.zeros(3), *base]) + at)
    return Mesh(np.asarray(hull.vertices, float), np.asarray(hull.faces, np.int64))


def blade(along, at):
    """Make a roof whose ridge is an edge along x or y through a point, long; it points up."""
    side = np.array([ASIDE, [0, 1.0, 0]])[1 - along]
    ridge = 10 * np.array([ASIDE, [0, 1.0, 0]])[along]
    points = [s * ridge + foot for s in (-1, 1) for foot in (0 * UP, side - 2 * UP, -side - 2 * UP)]
    hull = trimesh.convex.convex_hull(np.array(points) + at)
    return Mesh(np.asarray(hull.vertices, float), np.asarray(hull.faces, np.int64))


@pytest.mark.parametrize("way", [UP, ASIDE, [1.0, -2.0, 0.5]])
def test_across_is_a_rotation_that_turns_a_way_upright(way):
    R = across(np.array(way))
    assert np.allclose(R @ R.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(R) == pytest.approx(1)
    assert R @ way == pytest.approx([0, 0, np.linalg.norm(way)])


def test_a_box_meets_what_is_above_it_where_it_begins():
    low, high = solid(box([0, 0, 0], [4, 4, 1])), box([1, 1, 4], [3, 3, 5])
    met = met_on_the_way(low, solid(high), UP)
    assert met.points > 0
    assert met.first == pytest.approx(3)
    bottom = high.V[high.F][:, :, 2].max(axis=1) == 4
    assert bottom[met.faces].any()


def test_it_does_not_meet_what_is_below_beside_or_beyond_its_reach():
    low, high = solid(box([0, 0, 0], [4, 4, 1])), solid(box([1, 1, 4], [3, 3, 5]))
    assert not met_on_the_way(high, low, UP).points
    assert not met_on_the_way(low, high, ASIDE).points
    assert not met_on_the_way(low, high, UP, reach=2.99).points
    assert met_on_the_way(low, high, UP, reach=3.01).points
    assert met_on_the_way(low, high, 5 * UP).first == pytest.approx(3)
    assert met_on_the_way(low, high, UP, first_only=True).points


def test_a_large_face_meets_a_tip_inside_it_and_a_tip_a_face():
    plate = solid(box([-9, -9, 0], [9, 9, 1], n=1))
    assert met_on_the_way(plate, tip([0.3, 0.2, 3.0], -UP), UP).first == pytest.approx(2)
    assert met_on_the_way(tip([0.3, 0.2, -2.0], UP), plate, UP).first == pytest.approx(2)


def test_edges_that_cross_are_met_where_no_corner_meets_a_face():
    below = blade(0, np.zeros(3))
    above = blade(1, np.zeros(3))
    above = Mesh(above.V * [1, 1, -1] + [0, 0, 1.5], above.F[:, ::-1])
    met = met_on_the_way(below, above, UP)
    assert met.first == pytest.approx(1.5)
    assert not met_on_the_way(below, above, -UP).points
    apart = Mesh(above.V + 13 * ASIDE, above.F)
    assert not met_on_the_way(below, apart, UP).points


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_verdicts_do_not_depend_on_how_solids_lie(seed):
    low, high = box([0, 0, 0], [4, 4, 1]), box([3.9, 3.9, 4], [6, 6, 5])
    beside = box([4.1, 0, 4], [6, 6, 5])
    corners = turned((np.array([[0.0, 0, 0], UP]), low.F), seed).V
    way = corners[1] - corners[0]
    low, high, beside = (Mesh(*turned(x, seed)) for x in (low, high, beside))
    assert met_on_the_way(low, high, way).first == pytest.approx(3)
    assert not met_on_the_way(low, beside, way).points


def test_a_tile_goes_straight_up_between_its_neighbours_but_not_askew():
    tiles = [solid(tile) for tile in coupon()]
    others = [tiles[k] for k in (1, 3, 5, 7)]
    for other in others:
        assert not met_on_the_way(tiles[4], other, UP).points
    askew = np.array([np.sin(np.radians(20)), 0, np.cos(np.radians(20))])
    assert any(met_on_the_way(tiles[4], other, askew).points for other in others)
    assert met_on_the_way(tiles[4], tiles[3], ASIDE).first <= TILE / 10 + GAP


def test_a_knob_goes_up_out_of_a_hole_that_opens_upward_only():
    for wide_below in (False, True):
        knob, hole = (solid(x) for x in dovetail(wide_below))
        assert bool(met_on_the_way(knob, hole, UP).points) == wide_below
        assert bool(met_on_the_way(hole, knob, UP).points) != wide_below
        assert not met_on_the_way(knob, hole, -ASIDE).points


@pytest.mark.parametrize("shift", [[0.0, 0, 0], [0.09, 0, 0], [0, -0.09, 0.0]])
def test_many_trials_say_the_same_as_one_by_one(shift):
    tiles = [solid(tile) for tile in coupon()]
    V, F, _, _ = concatenate([tiles[k] for k in (1, 3, 5, 7)])
    trials = Trials(tiles[4], Mesh(V, F))
    moved = Mesh(tiles[4].V + shift, tiles[4].F)
    verdicts = []
    for lean in (0.0, 0.01, 0.03, 0.1, 0.3):
        for turn in np.linspace(0, 2 * np.pi, 7):
            way = np.array([np.sin(lean) * np.cos(turn), np.sin(lean) * np.sin(turn), np.cos(lean)])
            verdicts.append(trials.is_free(way, np.array(shift)))
            assert verdicts[-1] == (not met_on_the_way(moved, Mesh(V, F), way).points)
    assert 7 <= sum(verdicts) < len(verdicts)
