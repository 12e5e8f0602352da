"""Pieces from outside are checked once; what follows from them is the same as from each alone."""

import pickle

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.mesh.pieces import Pieces
from tests.check.pieces import box

ROW = [box([k, 0, 0], [k + 0.9, 1, 1], 1) for k in (0.0, 1.0, 3.0)]


def test_pieces_without_a_name_are_numbered():
    assert Pieces.of([("a", *ROW[0]), ROW[1]]).names == ("a", "piece_002")


def test_boxes_are_close_within_a_reach():
    pieces = Pieces.of(ROW)
    assert pieces.close(0.05).tolist() == []
    assert pieces.close(0.11).tolist() == [[0, 1]]
    assert pieces.close(2.0).tolist() == [[0, 1], [1, 2]]


def test_only_solids_have_a_body():
    pieces = Pieces.of([ROW[0], (ROW[1].V, ROW[1].F[1:])])
    assert [body is None for body in pieces.bodies] == [False, True]


def test_pieces_travel_without_what_follows_from_them():
    pieces = Pieces.of(ROW, [(0, 1)])
    before = pieces.boxes, pieces.bodies
    twin = pickle.loads(pickle.dumps(pieces))
    assert twin.names == pieces.names
    np.testing.assert_array_equal(twin.neighbours, [[0, 1]])
    np.testing.assert_array_equal(twin.boxes, before[0])


@pytest.mark.parametrize("neighbours", [[(0, 3)], [(-1, 0)]])
def test_neighbours_that_do_not_exist_are_refused(neighbours):
    with pytest.raises(InputError, match="beyond the 3"):
        Pieces.of(ROW, neighbours)
