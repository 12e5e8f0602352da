"""The preview: what the puzzle looks like, whole and taken apart, from two sides."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from meshjig.mesh.types import Floats
from meshjig.output.concatenate import together
from meshjig.output.pictures.explosion import exploded
from meshjig.output.pictures.render import render
from meshjig.output.pictures.scene import scene_of, shifted
from meshjig.output.pictures.view import View, axis_of, guess_up, view_of
from meshjig.output.piece import Piece

__all__ = ["preview"]

_SIDES = ((30.0, 18.0), (210.0, 18.0))  # azimuth and elevation, degrees


def preview(
    pieces: Sequence[Piece], path: Path, up: str = "auto", size: int = 1600, apart: float = 0.6
) -> None:
    """Draw a square sheet of four: above, the puzzle from two sides; below, the same exploded.

    Parameters
    ----------
    pieces : Piece
    path : Path, a PNG
    up : str
        The axis that points up: x, y, z, -x, -y, -z, or ``auto`` (see ``guess_up``).
    size : int, pixels along each side of the sheet
    apart : float, how much farther from the middle pieces stand when exploded

    Raises
    ------
    OptionError
        No such axis.
    """
    from PIL import Image

    V, F, piece_of_vertex, piece_of_face = together(pieces)
    upward = guess_up(V, F) if up == "auto" else axis_of(up)
    colour = np.concatenate([_looks(piece) for piece in pieces])
    sheet = np.full((size, size, 3), 255, np.uint8)
    half = size // 2
    whole = scene_of(V, F, colour, piece_of_face)
    W = exploded(V, piece_of_vertex, apart)
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
