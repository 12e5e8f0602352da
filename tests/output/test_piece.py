import numpy as np
import pytest

from meshjig.output.piece import Piece, explode_pieces, exploded, explosion
from tests.meshes import creased_box, moved, sphere, torus

PLACES = [[0, 0, 0], [120, 0, 0], [0, 150, 40], [-130, 20, -90]]
PIECES = [
    Piece(f"piece_{k + 1:03d}", *moved(shape, place), (0.5, 0.5, 0.5))
    for k, (shape, place) in enumerate(
        zip([sphere(300), torus(500), creased_box(300), sphere(80)], PLACES, strict=True)
    )
]


def box_middle(pieces):
    V = np.concatenate([piece.V for piece in pieces])
    return (V.min(0) + V.max(0)) / 2


@pytest.mark.parametrize("amount", [0.0, 0.6, 1.5])
def test_pieces_keep_their_shape_and_their_middles_lie_farther_out(amount):
    middle = box_middle(PIECES)
    for before, after in zip(PIECES, explode_pieces(PIECES, amount), strict=True):
        np.testing.assert_allclose(after.V - after.V[0], before.V - before.V[0], atol=1e-9)
        np.testing.assert_allclose(
            after.V.mean(0) - middle, (1 + amount) * (before.V.mean(0) - middle), atol=1e-9
        )
        assert (after.name, after.colour) == (before.name, before.colour)
        assert after.F is before.F


def test_all_pieces_part_in_the_same_proportion():
    def distances(pieces):
        centre = np.array([piece.V.mean(0) for piece in pieces])
        return np.linalg.norm(centre[:, None] - centre[None], axis=2)

    np.testing.assert_allclose(distances(explode_pieces(PIECES, 0.8)), 1.8 * distances(PIECES), atol=1e-9)


def test_vertices_in_any_order_move_with_their_piece():
    V = np.concatenate([piece.V for piece in PIECES])
    owner = np.repeat(np.arange(len(PIECES)), [len(piece.V) for piece in PIECES])
    shuffled = np.random.default_rng(1).permutation(len(V))
    moved_V = exploded(V[shuffled], owner[shuffled], 0.7)
    expected = np.concatenate([piece.V for piece in explode_pieces(PIECES, 0.7)])
    np.testing.assert_allclose(moved_V, expected[shuffled], atol=1e-9)


def test_one_piece_alone_stays_and_none_gives_none():
    V = sphere(300).V
    np.testing.assert_allclose(explosion(V, np.zeros(len(V), np.int64)), [[0, 0, 0]], atol=1e-9)
    assert explode_pieces([], 1.0) == []


def test_with_ways_pieces_move_along_these_the_farther_the_later_they_go_in():
    ways = np.array([[0.0, 1, 0], [0.6, 0.8, 0], [0, 0, 0], [-1, 0, 0]])
    V = np.concatenate([piece.V for piece in PIECES])
    owner = np.repeat(np.arange(4), [len(piece.V) for piece in PIECES])
    moves, as_ever = explosion(V, owner, ways), explosion(V, owner)
    length = np.linalg.norm(moves, axis=1)
    for k in (0, 1, 3):
        np.testing.assert_allclose(moves[k], length[k] * ways[k], atol=1e-9)
    assert 5 < length[0] < length[1] < length[3]
    np.testing.assert_allclose(moves[2], as_ever[2])  # nobody knows how it goes out
    for k, piece in enumerate(explode_pieces(PIECES, 0.5, ways)):
        np.testing.assert_allclose(piece.V, PIECES[k].V + 0.5 * moves[k], atol=1e-9)
    np.testing.assert_allclose(
        exploded(V, owner, 0.5, ways), np.concatenate([p.V for p in explode_pieces(PIECES, 0.5, ways)])
    )
