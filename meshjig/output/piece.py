"""What every writer is given: named and coloured solids, in place or moved apart."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.mesh import concatenate
from meshjig.output.texture import Texture

__all__ = ["Piece", "explode_pieces", "exploded", "explosion"]


@dataclass(frozen=True, eq=False)
class Piece:
    """One solid in its assembled position.

    ``check.pieces`` judges solids; here they only have a name and a colour more.
    """

    name: str
    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    colour: tuple[float, float, float]  # red, green, blue as a screen shows them, 0 to 1
    texture: Texture | None = field(default=None, kw_only=True)  # where the scan had a picture
    outer_normal: Floats | None = field(default=None, kw_only=True)  # (3,), mean of the outer sheet, mm2

    @property
    def colour_of_face(self) -> Floats:
        """What each face shows on the whole, sRGB, (m, 3)."""
        if self.texture is None:
            return np.tile(self.colour, (len(self.F), 1))
        return self.texture.rgb.mean(axis=1)

    def __eq__(self, other: object) -> bool:
        """Tell whether the other is the same solid by the same name, to the last bit; colours may differ."""
        if not isinstance(other, Piece):
            return NotImplemented
        same = np.array_equal(self.V, other.V) and np.array_equal(self.F, other.F)
        return self.name == other.name and same


def explosion(V: Floats, piece_of_vertex: Ints) -> Floats:
    """Give where, and how far, each piece goes when everything is scaled to twice its size.

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
    return V + amount * explosion(V, piece_of_vertex)[piece_of_vertex]


def explode_pieces(pieces: Sequence[Piece], amount: float) -> list[Piece]:
    """Give the same pieces moved outward, as ``exploded`` moves their vertices."""
    if not pieces:
        return []
    V, _, piece_of_vertex, _ = concatenate(pieces)
    moves = amount * explosion(V, piece_of_vertex)
    return [replace(piece, V=piece.V + move) for piece, move in zip(pieces, moves, strict=True)]
