"""One picture of a puzzle put together."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import OptionError, OutputError
from meshjig.output.concatenate import together
from meshjig.output.pictures.render import render
from meshjig.output.pictures.scene import scene_of
from meshjig.output.pictures.view import View, guess_up, view_of
from meshjig.output.piece import Piece

__all__ = ["draw_whole"]

_SIDE = (30.0, 18.0)  # azimuth and elevation, degrees
_LEAST = 16  # pixels


def draw_whole(pieces: Sequence[Piece], size: int = 800) -> NDArray[np.uint8]:
    """Draw a puzzle from the side from which previews show it first.

    Parameters
    ----------
    pieces : sequence of Piece, at least one
    size : int, pixels along each side

    Returns
    -------
    (size, size, 3) uint8, sRGB, on white

    Raises
    ------
    OutputError
        There are no pieces.
    OptionError
        The picture would have fewer than 16 pixels a side.
    """
    if not pieces:
        raise OutputError("a puzzle without pieces can't be shown", hint="make one first")
    if size < _LEAST:
        raise OptionError(f"plot: {size} pixels make no picture", hint=f"use {_LEAST} or more")
    V, F, _, piece_of_face = together(pieces)
    tint = [np.tile(p.colour, (len(p.F), 1)) if p.coat is None else p.coat.rgb.mean(axis=1) for p in pieces]
    scene = scene_of(V, F, np.concatenate(tint), piece_of_face)
    view = view_of(V, guess_up(V, F), *_SIDE)
    return render(scene, View(view.eye, view.axes, view.centre, 1.08 * view.half), size)
