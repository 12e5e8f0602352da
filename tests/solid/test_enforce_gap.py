import numpy as np
import pytest
import trimesh

from meshjig.check import gaps, is_closed_as_stl, overlaps, self_intersections
from meshjig.solid.enforce_gap import enforce_gap


def box(low, high, ball=None):
    """A box, with a ball grown out of it."""
    mesh = trimesh.creation.box(bounds=[low, high])
    if ball is not None:
        bump = trimesh.creation.icosphere(2, 0.5)
        bump.apply_translation(ball)
        mesh = trimesh.boolean.union([mesh, bump], engine="manifold")
    return np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int64)


def volume(piece):
    return trimesh.Trimesh(piece[0], piece[1], process=False).volume


@pytest.mark.parametrize("ball", [[4.4, 5, 1], [4.4, 5, 2.05], [4.35, 0.2, 0.3]])
def test_a_bump_that_comes_too_near_is_dented_and_so_is_its_neighbour(ball):
    pieces = {3: box([0, 0, 0], [4, 10, 2], ball), 5: box([5, 0, 0], [9, 10, 2])}
    assert gaps(list(pieces.values()), neighbours=[[0, 1]], clearance=0.2).min < 0.19
    changed = enforce_gap(pieces, np.array([[3, 5]]), 0.2)
    assert set(changed) == {3, 5}
    after = [changed[i][:2] for i in (3, 5)]
    assert gaps(after, neighbours=[[0, 1]], clearance=0.2).min >= 0.19
    for i, piece in zip((3, 5), after, strict=True):
        assert is_closed_as_stl(*piece)
        assert not len(self_intersections(*piece))
        assert 0 < volume(pieces[i]) - volume(piece) < 0.3


def test_what_is_far_enough_apart_is_left_alone():
    pieces = {0: box([0, 0, 0], [4, 10, 2]), 1: box([4.2, 0, 0], [9, 10, 2]), 2: box([0, 20, 0], [9, 30, 2])}
    assert enforce_gap(pieces, np.array([[0, 1], [0, 2], [1, 7]]), 0.2) == {}


def test_pieces_that_overlap_are_left_to_the_checks():
    pieces = {0: box([0, 0, 0], [4, 10, 2]), 1: box([3.9, 0, 0], [9, 10, 2])}
    assert enforce_gap(pieces, np.array([[0, 1]]), 0.2) == {}
    assert overlaps(list(pieces.values())).total > 1
