"""Which pieces are touched by crossings that the surface brought along."""

import numpy as np

from meshjig.mesh.types import Ints

__all__ = ["touched_pieces"]


def touched_pieces(pairs: Ints, parent: Ints, piece_of_face: Ints) -> set[int]:
    """Give the pieces that hold a part of a face that crossed another before anything was cut.

    A piece cannot be cleaner than the surface it is made of: where that passes through itself, so do the
    pieces, or two of them share space.

    Parameters
    ----------
    pairs : (k, 2) int64, faces of the uncut surface that cross
    parent : (m,) int64, for each face of the cut surface, the uncut one that it is a part of
    piece_of_face : (m,) int64, of the cut surface, negative where a face belongs to no piece

    Returns
    -------
    set of int, pieces; proven for exactly these pairs: a face is touched when it is named in one of them
    """
    crossing = np.zeros(int(max(parent.max(initial=-1), pairs.max(initial=-1))) + 1, bool)
    crossing[pairs] = True
    return set(np.unique(piece_of_face[crossing[parent] & (piece_of_face >= 0)]).tolist())
