"""Motions past boxes and tiles, where it is known which there are."""

import numpy as np
import pytest

from meshjig.check.straight import met_on_the_way
from meshjig.mesh.mesh import Mesh
from meshjig.pipeline.find_motions import find_motions
from tests.check.jigsaws import GAP, coupon, dovetail, ring
from tests.check.pieces import box

UP, ASIDE = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def found(shapes, way=UP, give=0.0, rank=None, **known):
    solids = [Mesh(*shape) for shape in shapes]
    rank = np.arange(len(solids)) if rank is None else np.asarray(rank)
    ways = np.broadcast_to(np.asarray(way, float), (len(solids), 3))
    return find_motions(solids, rank, ways, GAP, give, **known)


def lip_and_lid(over):
    """A lid, and a lip that reaches some way over it."""
    return [box([-5, 0, 3], [0.2 + over, 10, 4]), box([0.2, 0.2, 0], [9.8, 9.8, 2])]


def test_tiles_of_a_sheet_go_out_as_planned():
    for motion in found(coupon()).motions:
        assert motion.way.tolist() == UP.tolist()
        assert not motion.shift.any()
        assert motion.met == {}


def test_what_holds_a_piece_is_named_with_how_often():
    hole, knob = dovetail(True)[::-1]
    motions = found([hole, knob]).motions
    assert [list(motion.met) for motion in motions] == [[], [0]]
    assert motions[1].met[0] > 0
    assert [motion.met for motion in found([hole, knob], rank=[1, 0]).motions] == [{}, {}]


def test_the_last_block_of_a_ring_has_no_motion():
    ways = np.array([[0, 1.0, 0], [-1, 0, 0], [0, -1, 0], [1, 0, 0]])
    motions = found(ring(), ways, rank=[3, 0, 1, 2]).motions
    assert [bool(motion.met) for motion in motions] == [True, False, False, False]
    assert set(motions[0].met) <= {1, 2, 3}


def test_a_piece_is_moved_aside_where_that_frees_it():
    shapes = lip_and_lid(0.05)
    motion = found(shapes).motions[1]
    assert motion.met == {}
    assert np.linalg.norm(motion.shift) == pytest.approx(0.45 * GAP)
    assert motion.shift[0] > 0.05
    lip, lid = (Mesh(*shape) for shape in shapes)
    assert not met_on_the_way(Mesh(lid.V + motion.shift, lid.F), lip, motion.way).points


def test_a_piece_is_pressed_past_what_it_only_touches_by_what_it_gives():
    walled = [*lip_and_lid(0.02), box([9.82, 0, 0], [12, 10, 2]), box([-5, -3, 3], [12, 0.22, 4])]
    walled += [box([-5, 9.78, 3], [12, 13, 4])]  # no room to move aside
    rank = [0, 4, 1, 2, 3]
    motion = found(walled, give=0.05, rank=rank).motions[1]
    assert (motion.met, motion.shift.any(), motion.way.tolist()) == ({}, False, UP.tolist())
    rigid = found(walled, rank=rank).motions[1]
    assert rigid.met or rigid.way.tolist() != UP.tolist()


def test_another_way_near_the_planned_one_is_found():
    plate, roof = box([0, 0, 0], [10, 10, 1]), box([9.5, -20, 20], [30, 30, 21])
    motion = found([roof, plate]).motions[1]
    assert motion.met == {}
    assert 2 < np.degrees(np.arccos(motion.way @ UP)) < 10
    assert not met_on_the_way(Mesh(*plate), Mesh(*roof), motion.way).points


def test_what_is_known_is_kept_where_nothing_near_has_changed():
    shapes = coupon()
    first = found(shapes)
    marked = first._replace(motions=[motion._replace(met={99: 1}) for motion in first.motions])
    changed = np.zeros(9, bool)
    changed[0] = True
    again = found(shapes, before=(marked, changed))
    assert [k for k, motion in enumerate(again.motions) if not motion.met] == [
        k for k in range(9) if k == 0 or 0 in first.near[k]
    ]
    assert all(motion.met for motion in found(shapes, before=(marked, np.zeros(9, bool))).motions)
    other = found(shapes, ASIDE, before=(marked, np.zeros(9, bool)))
    assert not any(99 in motion.met for motion in other.motions)
