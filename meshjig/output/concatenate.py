"""All pieces as one mesh, with who is whose."""

from collections.abc import Sequence

import numpy as np

from meshjig.mesh.types import Floats, Ints
from meshjig.output.piece import Piece

__all__ = ["together"]


def together(pieces: Sequence[Piece]) -> tuple[Floats, Ints, Ints, Ints]:
    """Join pieces into one mesh.

    Parameters
    ----------
    pieces : sequence of Piece, at least one

    Returns
    -------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    piece_of_vertex : (n,) int64, counted from 0
    piece_of_face : (m,) int64
    """
    n_vertices = np.array([len(piece.V) for piece in pieces])
    first = np.cumsum(n_vertices) - n_vertices
    V = np.concatenate([piece.V for piece in pieces])
    F = np.concatenate([piece.F + start for piece, start in zip(pieces, first, strict=True)])
    numbers = np.arange(len(pieces))
    return V, F, np.repeat(numbers, n_vertices), np.repeat(numbers, [len(piece.F) for piece in pieces])
