"""A puzzle taken apart: every piece moved outward, none turned."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from meshjig.mesh.types import Floats, Ints
from meshjig.output.concatenate import together
from meshjig.output.piece import Piece

__all__ = ["explode_pieces", "exploded", "ways_out"]


def ways_out(V: Floats, piece_of_vertex: Ints) -> Floats:
    """Say which way, and how far, each piece goes when everything is scaled to twice its size.

    Parameters
    ----------
    V : (n, 3) float64, mm
    piece_of_vertex : (n,) int64, counted from 0

    Returns
    -------
    (p, 3) float64, mm: from the middle of the model's box to the mean of a piece's vertices. Moves in
    proportion to it widen the gaps between all pieces alike, along limbs too, and keep any two from
    meeting.
    """
    count = np.maximum(np.bincount(piece_of_vertex), 1)
    centre: Floats = np.stack([np.bincount(piece_of_vertex, x) for x in V.T], 1) / count[:, None]
    return centre - (V.min(axis=0) + V.max(axis=0)) / 2


def exploded(V: Floats, piece_of_vertex: Ints, amount: float) -> Floats:
    """Move the vertices of pieces outward.

    Parameters
    ----------
    V : (n, 3) float64, mm
    piece_of_vertex : (n,) int64, counted from 0
    amount : float; 0 leaves all in place, 1 moves the middle of each piece twice as far out

    Returns
    -------
    (n, 3) float64, mm
    """
    return V + amount * ways_out(V, piece_of_vertex)[piece_of_vertex]


def explode_pieces(pieces: Sequence[Piece], amount: float) -> list[Piece]:
    """Give the same pieces moved outward, as ``exploded`` moves their vertices."""
    if not pieces:
        return []
    V, _, piece_of_vertex, _ = together(pieces)
    moves = amount * ways_out(V, piece_of_vertex)
    return [replace(piece, V=piece.V + move) for piece, move in zip(pieces, moves, strict=True)]
