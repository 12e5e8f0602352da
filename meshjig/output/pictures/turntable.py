"""The turntable: a puzzle that turns once around, as an animated GIF."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from meshjig.errors import OptionError, OutputError
from meshjig.output.concatenate import together
from meshjig.output.pictures.render import render
from meshjig.output.pictures.scene import scene_of
from meshjig.output.pictures.view import View, guess_up, view_of
from meshjig.output.piece import Piece

__all__ = ["write_turntable"]

_ELEVATION = 18.0  # degrees
_ONCE_AROUND = 4000  # milliseconds


def write_turntable(path: Path, pieces: Sequence[Piece], frames: int = 36, size: int = 480) -> None:
    """Draw a puzzle from all around and write the pictures as a GIF that runs forever.

    Parameters
    ----------
    path : Path
    pieces : sequence of Piece, at least one
    frames : int, pictures once around
    size : int, pixels along each side

    Raises
    ------
    OutputError
        There are no pieces.
    OptionError
        Fewer than two pictures, or a picture of less than 16 pixels.
    """
    if not pieces:
        raise OutputError("a puzzle without pieces can't be shown", hint="make one first")
    if frames < 2 or size < 16:
        raise OptionError(
            f"turntable: {frames} frames of {size} pixels make no picture that turns",
            hint="use 2 frames or more, of 16 pixels or more",
        )
    from PIL import Image
    from scipy.spatial import ConvexHull

    V, F, _, piece_of_face = together(pieces)
    tint = [np.tile(p.colour, (len(p.F), 1)) if p.coat is None else p.coat.rgb.mean(axis=1) for p in pieces]
    scene = scene_of(V, F, np.concatenate(tint), piece_of_face)
    up = guess_up(V, F)
    outline = V[ConvexHull(V).vertices]
    views = [view_of(outline, up, 30 + 360 * k / frames, _ELEVATION) for k in range(frames)]
    widest = 1.06 * max(view.half for view in views)
    still = np.mean([view.centre for view in views], axis=0)
    pictures = [render(scene, View(view.eye, view.axes, still, widest), size) for view in views]
    some = np.hstack(pictures[:: max(1, frames // 4)])
    palette = Image.fromarray(some).quantize(256, method=Image.Quantize.MEDIANCUT)
    first, *rest = [
        Image.fromarray(picture).quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures
    ]
    first.save(path, save_all=True, append_images=rest, duration=_ONCE_AROUND // frames, loop=0)
