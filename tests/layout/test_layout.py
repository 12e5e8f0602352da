import numpy as np

from meshjig.layout.layout import affected_pieces
from meshjig.mesh.types import GAP

PARENT = np.array([0, 0, 1, 2, 2, 3])
PIECE = np.array([0, GAP, 1, 1, 2, 3])


def test_pieces_with_a_part_of_a_crossing_face_are_touched():
    assert affected_pieces(np.array([[0, 2]]), PARENT, PIECE) == {0, 1, 2}
    assert affected_pieces(np.array([[1, 3]]), PARENT, PIECE) == {1, 3}


def test_faces_in_the_gap_touch_nothing():
    assert affected_pieces(np.array([[0, 1]]), PARENT[1:2], PIECE[1:2]) == set()


def test_a_clean_surface_touches_nothing():
    assert affected_pieces(np.zeros((0, 2), np.int64), PARENT, PIECE) == set()


def test_crossing_faces_that_were_not_cut_out_do_not_matter():
    assert affected_pieces(np.array([[7, 9]]), PARENT, PIECE) == set()
