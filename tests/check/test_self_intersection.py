import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshjig.check import is_closed_as_stl, overlaps, self_intersections, volume
from meshjig.errors import InputError
from tests.check.pieces import box, folded_plate, hemisphere_shells, turned
from tests.meshes import creased_box, genus2, joined, moved, sphere, torus

BLOCK = box([0, 0, 0], [10, 10, 10])


@pytest.mark.parametrize(
    "piece", [sphere(500), torus(500), genus2(500), creased_box(300), *hemisphere_shells(9, 2, 1)]
)
@pytest.mark.parametrize("seed", [0, 1])
def test_sound_pieces_do_not_cross_themselves(piece, seed):
    V, F = turned(piece, seed)
    assert len(self_intersections(V, F)) == 0
    assert len(self_intersections(V.astype(np.float32), F)) == 0


@pytest.mark.parametrize("seed", [0, 1])
def test_only_the_crossing_test_sees_a_fold(seed):
    V, F = turned(folded_plate(), seed)
    assert is_closed_as_stl(V, F)
    assert volume(V, F) > 0
    assert overlaps([(V, F)]).unmeasured == []
    assert len(self_intersections(V, F)) > 0


@given(st.floats(-0.5, 0.5), st.integers(0, 9))
def test_boxes_cross_when_one_reaches_into_the_other(reach, seed):
    V, F = turned(joined(BLOCK, box([10 - reach, 2.1, 2.2], [15, 7.3, 7.4])), seed)
    found = self_intersections(V, F)
    if reach < 0.004:
        assert len(found) == 0
    elif reach > 0.006:
        assert len(found) > 0
        assert (found[:, 0] < len(BLOCK[1])).all()  # every pair is one face of either box
        assert (found[:, 1] >= len(BLOCK[1])).all()


def test_the_depth_that_counts_is_the_callers():
    V, F = joined(BLOCK, box([9.99, 2.1, 2.2], [15, 7.3, 7.4]))
    assert len(self_intersections(V, F, depth=0.0099)) > 0
    assert len(self_intersections(V, F, depth=0.0101)) == 0


def test_contact_is_no_crossing():
    V, F = joined(BLOCK, box([10, 0, 0], [20, 10, 10], 3))
    assert len(self_intersections(V, F)) == 0


@pytest.mark.parametrize("apart", [0.5, 0.999, 1.001, 1.5])
def test_spheres_cross_when_their_centres_are_nearer_than_both_radii(apart):
    ball = sphere(5000, 10)
    V, F = joined(ball, moved(ball, [20.0 * apart, 0, 0]))
    assert (len(self_intersections(V, F)) > 0) == (apart < 1)


def test_a_corner_shared_does_not_hide_a_crossing():
    V = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [2, 1, -1], [2, 1, 1.0]])
    F = np.array([[0, 1, 2], [0, 3, 4]])
    assert self_intersections(V, F).tolist() == [[0, 1]]


def test_faces_without_area_are_left_out():
    V, F = BLOCK
    thin = np.array([[0, 1, 1], [2, 2, 2]])
    assert len(self_intersections(V, np.concatenate([F, thin]))) == 0


def test_face_numbers_are_those_given_in():
    V, F = joined(BLOCK, box([9, 2.1, 2.2], [15, 7.3, 7.4]))
    shifted = np.concatenate([[[0, 0, 0]] * 7, F])
    np.testing.assert_array_equal(self_intersections(V, shifted), self_intersections(V, F) + 7)


@pytest.mark.parametrize(
    ("V", "F", "what"),
    [
        (np.full((3, 3), np.nan), [[0, 1, 2]], "finite"),
        (np.zeros((3, 3)), [[0, 1, 3]], "do not exist"),
        (np.zeros((3, 3)), [[0, 1, -1]], "do not exist"),
        (np.zeros((3, 2)), [[0, 1, 2]], "shape"),
        (np.zeros((3, 3)), np.zeros((0, 3)), "no faces"),
    ],
)
def test_arrays_that_native_code_would_trip_over_are_refused(V, F, what):
    with pytest.raises(InputError, match=what):
        self_intersections(V, F)
