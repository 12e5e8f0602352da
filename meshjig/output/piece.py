"""What every writer is given: named and coloured solids, in place or moved apart."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.mesh import concatenate
from meshjig.output.texture import Texture

__all__ = ["Piece", "explode_pieces", "exploded", "explosion"]

_FIRST, _LAST = 0.2, 0.65  # how far the first and last piece go along their ways, halves of the diagonal


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


def explosion(V: Floats, piece_of_vertex: Ints, ways: Floats | None = None) -> Floats:
    """Give where, and how far, each piece goes when the puzzle is taken apart.

    Parameters
    ----------
    V : (n, 3) float64, mm
    piece_of_vertex : (n,) int64, counted from 0
    ways : (p, 3) float64, unit, optional
        In which direction each piece goes out, the first that is put in first; zero where none is known.

    Returns
    -------
    (p, 3) float64, mm
        Without ways, from the middle of the model's box to the mean of a piece's vertices: everything is
        scaled to twice its size. Moves in proportion to it widen the gaps between all pieces alike, along
        limbs too, and keep any two from meeting. With ways, along these, and the farther the later a piece
        goes in, so that it leaves behind what was there before it.
    """
    count = np.maximum(np.bincount(piece_of_vertex), 1)
    centre: Floats = np.stack([np.bincount(piece_of_vertex, x) for x in V.T], 1) / count[:, None]
    low, high = V.min(axis=0), V.max(axis=0)
    apart = centre - (low + high) / 2
    if ways is None:
        return apart
    later = np.linspace(_FIRST, _LAST, len(ways))
    along = (np.linalg.norm(high - low) / 2 * later)[:, None] * ways
    return np.where(np.any(ways, axis=1)[:, None], along, apart)


def exploded(V: Floats, piece_of_vertex: Ints, amount: float, ways: Floats | None = None) -> Floats:
    """Move the vertices of pieces apart.

    Parameters
    ----------
    V : (n, 3) float64, mm
    piece_of_vertex : (n,) int64, counted from 0
    amount : float; 0 leaves all in place, 1 moves each as far as `explosion` says
    ways : (p, 3) float64, unit, optional
        In which direction each piece goes out.

    Returns
    -------
    (n, 3) float64, mm
    """
    return V + amount * explosion(V, piece_of_vertex, ways)[piece_of_vertex]


def explode_pieces(pieces: Sequence[Piece], amount: float, ways: Floats | None = None) -> list[Piece]:
    """Give the same pieces moved apart, as ``exploded`` moves their vertices."""
    if not pieces:
        return []
    V, _, piece_of_vertex, _ = concatenate(pieces)
    moves = amount * explosion(V, piece_of_vertex, ways)
    return [replace(piece, V=piece.V + move) for piece, move in zip(pieces, moves, strict=True)]
