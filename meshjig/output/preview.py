"""The preview: what the puzzle looks like, whole and taken apart, from two sides."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from meshjig.output.piece import Piece
from meshjig.output.render import render
from meshjig.output.scene import scene_of, shifted
from meshjig.output.view import View, axis_of, guess_up, view_of
from meshjig.types import Floats, Ints

__all__ = ["preview"]

_SIDES = ((30.0, 18.0), (210.0, 18.0))  # azimuth and elevation, degrees
_APART = 0.6  # how much farther from the middle pieces stand when exploded


def preview(pieces: Sequence[Piece], path: Path, up: str = "auto", size: int = 1600) -> None:
    """Draw a square sheet of four: above, the puzzle from two sides; below, the same exploded.

    Parameters
    ----------
    pieces : Piece
    path : Path, a PNG
    up : str
        The axis that points up: x, y, z, -x, -y, -z, or ``auto`` (see ``guess_up``).
    size : int, pixels along each side of the sheet

    Raises
    ------
    OptionError
        No such axis.
    """
    from PIL import Image

    V, F, piece_of_vertex, piece_of_face = _together(pieces)
    upward = guess_up(V, F) if up == "auto" else axis_of(up)
    colour = np.concatenate([_looks(piece) for piece in pieces])
    sheet = np.full((size, size, 3), 255, np.uint8)
    half = size // 2
    whole = scene_of(V, F, colour, piece_of_face)
    W = _exploded(V, piece_of_vertex)
    for row, (points, scene, line, fog) in enumerate(
        [(V, whole, 1.0, 0.0), (W, shifted(whole, W), 0.75, 0.5)]
    ):
        views = [view_of(points, upward, azimuth, elevation) for azimuth, elevation in _SIDES]
        widest = 1.08 * max(view.half for view in views)
        for column, view in enumerate(views):
            same_scale = View(view.eye, view.axes, view.centre, widest)
            picture = render(scene, same_scale, half, line=line, fog=fog)
            sheet[row * half : (row + 1) * half, column * half : (column + 1) * half] = picture
    Image.fromarray(sheet).save(path, optimize=False, compress_level=6)


def _looks(piece: Piece) -> Floats:
    """Give the colour of every face, (m, 3)."""
    if piece.coat is None:
        return np.tile(piece.colour, (len(piece.F), 1))
    return piece.coat.rgb.mean(axis=1)


def _together(pieces: Sequence[Piece]) -> tuple[Floats, Ints, Ints, Ints]:
    """Join pieces into one mesh: V, F, piece_of_vertex, piece_of_face."""
    n_vertices = np.array([len(piece.V) for piece in pieces])
    offset = np.cumsum(n_vertices) - n_vertices
    V = np.concatenate([piece.V for piece in pieces])
    F = np.concatenate([piece.F + start for piece, start in zip(pieces, offset, strict=True)])
    numbers = np.arange(len(pieces))
    return V, F, np.repeat(numbers, n_vertices), np.repeat(numbers, [len(piece.F) for piece in pieces])


def _exploded(V: Floats, piece_of_vertex: Ints) -> Floats:
    """Move each piece away from the middle in proportion to how far its own middle lies out.

    This scales the gaps between all pieces alike, along limbs too, and keeps any two from meeting.
    """
    count = np.bincount(piece_of_vertex)
    centre = np.stack([np.bincount(piece_of_vertex, x) for x in V.T], 1) / np.maximum(count, 1)[:, None]
    middle = (V.min(axis=0) + V.max(axis=0)) / 2
    return V + _APART * (centre - middle)[piece_of_vertex]
