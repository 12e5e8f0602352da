import numpy as np
import pytest

from meshjig.check import is_closed, is_closed_as_stl, is_one_component, volume
from tests.check.pieces import box, folded_plate, hemisphere_shells
from tests.meshes import genus2, inside_out, joined, moebius, open_cup, sphere, torus, two_components

CUBE = box([0, 0, 0], [1, 1, 1], 1)


@pytest.mark.parametrize(
    "piece", [sphere(200), torus(200), genus2(200), CUBE, folded_plate(), *hemisphere_shells(9, 2, 1)]
)
def test_a_closed_piece_is_closed(piece):
    V, F = piece
    assert is_closed(F)
    assert is_closed_as_stl(V, F)
    assert is_one_component(F)
    assert volume(V, F) > 0


def test_no_piece_is_closed_without_one_of_its_faces():
    for face in range(len(CUBE[1])):
        assert not is_closed(np.delete(CUBE[1], face, axis=0))


def test_no_piece_is_closed_with_one_face_turned():
    for face in range(len(CUBE[1])):
        F = CUBE[1].copy()
        F[face] = F[face, ::-1]
        assert not is_closed(F)


@pytest.mark.parametrize("F", [np.zeros((0, 3), np.int64), open_cup(200)[1], moebius(200)[1]])
def test_borders_and_one_sided_surfaces_are_not_closed(F):
    assert not is_closed(F)


def test_a_face_twice_is_not_closed():
    F = CUBE[1]
    assert not is_closed(np.concatenate([F, F[:1]]))
    assert not is_closed(np.concatenate([F, F[:1], F[:1, ::-1]]))
    assert not is_closed(np.concatenate([F, [[0, 0, 1]]]))


def test_two_cubes_that_share_a_corner_or_an_edge_are_not_closed():
    V, F = joined(CUBE, box([1, 1, 1], [2, 2, 2], 1))
    assert is_closed(F)
    assert not is_closed_as_stl(V, F)
    V, F = joined(CUBE, box([1, 1, 0], [2, 2, 1], 1))
    assert not is_closed_as_stl(V, F)


def test_vertices_that_differ_only_in_double_precision_pinch_in_the_file():
    V, F = joined(CUBE, box([1 + 1e-12, 1, 1], [2, 2, 2], 1))
    assert is_closed(F)
    assert not is_closed_as_stl(V, F)


def test_a_micro_edge_collapses_in_the_file_and_leaves_it_closed():
    V, F = CUBE
    a, b, _ = F[0]
    split = _with_edge_split(F, a, b, len(V))
    V = np.concatenate([V, [V[a] + 1e-13 * (V[b] - V[a])]])
    assert len(split) == len(F) + 2
    assert is_closed(split)
    assert is_closed_as_stl(V, split)


def test_components_are_counted():
    assert is_one_component(sphere(200)[1])
    assert not is_one_component(two_components(200)[1])


def test_volume_has_a_sign_and_is_the_cubes():
    block = box([100, 200, 300], [101, 202, 303])
    assert volume(*block) == pytest.approx(6)
    assert volume(*inside_out(block)) == pytest.approx(-6)


def _with_edge_split(F, a, b, new):
    out = []
    for face in F.tolist():
        for k in range(3):
            if {face[k], face[(k + 1) % 3]} == {a, b}:
                p, q, r = face[k], face[(k + 1) % 3], face[(k + 2) % 3]
                out += [[p, new, r], [new, q, r]]
                break
        else:
            out.append(face)
    return np.array(out)


@pytest.mark.parametrize(("apart", "closed"), [(1e-9, False), (1e-6, True)])
def test_an_edge_of_four_faces_is_found_where_readers_take_two_vertices_for_one(apart, closed):
    V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    both = np.concatenate([V + np.array([apart, 0, 0]), V * [-1, -1, 1]])
    assert is_closed_as_stl(both, np.concatenate([F, F + 4])) is closed
