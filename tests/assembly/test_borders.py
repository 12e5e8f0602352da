"""The frames along a straight border of a flat sheet, and around a ball."""

import numpy as np
import pytest

from meshjig.assembly import border_edges
from tests.assembly.sheets import ball, sheet


def test_a_straight_border_has_the_sheet_s_own_frame():
    b = sheet(2, 1).borders
    assert b.pairs.tolist() == [[0, 1]]
    assert (b.side == [0, 1]).all()
    assert b.n_pieces == 2
    np.testing.assert_allclose(b.normal, np.tile([0, 0, 1], (10, 1)), atol=1e-12)
    np.testing.assert_allclose(b.conormal, np.tile([1, 0, 0], (10, 1)), atol=1e-12)
    np.testing.assert_allclose(b.tangent, np.tile([0, 1, 0], (10, 1)), atol=1e-12)
    assert b.length.sum() == pytest.approx(10)


def test_nine_squares_have_twelve_borders_of_the_same_length():
    b = sheet().borders
    assert len(b.pairs) == 12
    assert np.bincount(b.pair, b.length) == pytest.approx(np.full(12, 10.0))
    assert (b.pairs[b.pair] == b.side).all()


def test_faces_of_no_piece_have_no_border():
    s = sheet(2, 1)
    nowhere = np.where(s.piece == 1, -1, s.piece)
    b = border_edges(s.V, s.F, nowhere, s.D, np.zeros(len(s.V), bool))
    assert (len(b.pairs), len(b.tail), b.n_pieces) == (0, 0, 0)


def test_an_edge_is_a_knob_s_where_both_its_ends_are():
    s = sheet(2, 1)
    low = s.V[:, 1] < 4.5
    b = border_edges(s.V, s.F, s.piece, s.D, low)
    assert b.knob.sum() == 4
    assert (b.knob == (low[b.tail] & low[b.head])).all()


def test_frames_on_a_ball_are_at_right_angles_and_lead_out_of_the_lower_piece():
    s = ball()
    b = s.borders
    frame = np.stack([b.tangent, b.conormal, b.normal], 1)
    np.testing.assert_allclose(
        frame @ frame.transpose(0, 2, 1), np.tile(np.eye(3), (len(frame), 1, 1)), atol=1e-9
    )
    middle = (s.V[b.tail] + s.V[b.head]) / 2
    assert (np.einsum("ij,ij->i", b.normal, middle) > 0.99 * 20).all()
    own = np.array([s.V[s.F[s.piece == k]].mean(axis=(0, 1)) for k in range(b.n_pieces)])
    out = own[b.side[:, 1]] - own[b.side[:, 0]]
    by_pair = np.zeros(len(b.pairs))
    np.add.at(by_pair, b.pair, b.length * np.einsum("ij,ij->i", b.conormal, out))
    assert (by_pair > 0).all()
