"""Colours of faces as places in a picture of swatches, for files that have none for faces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from meshjig.output.piece import Piece
from meshjig.output.scan_picture import Picture

__all__ = ["by_palette"]

_SWATCH = 4  # pixels a side: what blends neighbouring pixels stays within
_A_ROW = 256  # swatches
_MOST = 2**16  # swatches: the picture is 1024 x 1024 pixels then


def by_palette(pieces: Sequence[Piece]) -> Sequence[Piece]:
    """Give pieces whose faces show one colour each a picture that holds these colours.

    Parameters
    ----------
    pieces : sequence of Piece

    Returns
    -------
    sequence of Piece
        The same where faces show a picture, several colours, or there are too many for a picture.
    """
    dressed = [piece.texture for piece in pieces if piece.texture is not None]
    tints = [texture.colour_of_faces for texture in dressed]
    known = [tint for tint in tints if tint is not None]
    if not known or len(known) < len(pieces):
        return pieces
    rgb = np.rint(255 * np.concatenate(known)).astype(np.int64)
    code, number = np.unique(rgb @ np.array([2**16, 2**8, 1]), return_inverse=True)
    if len(code) > _MOST:
        return pieces
    rows = -(-len(code) // _A_ROW)
    pixels = np.zeros((rows * _A_ROW, 3), np.uint8)
    pixels[: len(code)] = np.stack([code >> 16, code >> 8 & 255, code & 255], axis=1)
    swatches = pixels.reshape(rows, _A_ROW, 3).repeat(_SWATCH, axis=0).repeat(_SWATCH, axis=1)
    picture = Picture(swatches)
    row, column = np.divmod(number.ravel(), _A_ROW)
    uv = np.stack([(column + 0.5) / _A_ROW, 1 - (row + 0.5) / rows], axis=1)
    parts = np.split(uv, np.cumsum([len(tint) for tint in known])[:-1])
    return [
        replace(piece, texture=replace(texture, uv=np.repeat(part[:, None], 3, axis=1), picture=picture))
        for piece, texture, part in zip(pieces, dressed, parts, strict=True)
    ]
