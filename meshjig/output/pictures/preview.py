"""What a puzzle looks like: whole and taken apart from two sides, once around, and from its front."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import OptionError, OutputError
from meshjig.mesh.arrays import Floats
from meshjig.mesh.mesh import concatenate
from meshjig.output.pictures.render import render
from meshjig.output.pictures.scene import scene_of_pieces, shifted
from meshjig.output.pictures.view import View, guess_up, view_of
from meshjig.output.piece import Piece, exploded

__all__ = ["draw_whole", "write_preview", "write_turntable"]


_FRONT, _BACK = (30.0, 18.0), (210.0, 18.0)  # azimuth and elevation, degrees
_ONCE_AROUND = 4000  # milliseconds

_LEAST = 16  # pixels


def write_preview(
    path: Path,
    pieces: Sequence[Piece],
    up: Floats | None = None,
    size: int = 1600,
    apart: float = 0.6,
    ways: Floats | None = None,
) -> None:
    """Draw a square sheet of four: above, the puzzle from two sides; below, the same exploded.

    Parameters
    ----------
    path : Path, a PNG
    pieces : sequence of Piece, at least one
    up : (3,) float64, unit; guessed where it is not given, see `guess_up`
    size : int, pixels along each side of the sheet
    apart : float, how far pieces are moved when exploded, see `explosion`
    ways : (p, 3) float64, unit, optional
        In which direction each piece goes out.
    """
    from PIL import Image

    V, F, piece_of_vertex, _ = concatenate(pieces)
    upward = guess_up(V, F) if up is None else up
    sheet = np.full((size, size, 3), 255, np.uint8)
    half = size // 2
    whole = scene_of_pieces(pieces)
    W = exploded(V, piece_of_vertex, apart, ways)
    for row, (points, scene, line, fog) in enumerate(
        [(V, whole, 1.0, 0.0), (W, shifted(whole, W), 0.75, 0.5)]
    ):
        views = [view_of(points, upward, azimuth, elevation) for azimuth, elevation in (_FRONT, _BACK)]
        widest = 1.08 * max(view.half for view in views)
        for column, view in enumerate(views):
            same_scale = View(view.eye, view.axes, view.centre, widest)
            picture = render(scene, same_scale, half, line=line, fog=fog)
            sheet[row * half : (row + 1) * half, column * half : (column + 1) * half] = picture
    Image.fromarray(sheet).save(path, optimize=False, compress_level=6)


def write_turntable(
    path: Path, pieces: Sequence[Piece], up: Floats | None = None, frames: int = 36, size: int = 480
) -> None:
    """Draw a puzzle from all around and write the pictures as a GIF that runs forever.

    Parameters
    ----------
    path : Path
    pieces : sequence of Piece, at least one
    up : (3,) float64, unit; guessed where it is not given
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

    V, F, _, _ = concatenate(pieces)
    scene = scene_of_pieces(pieces)
    upward = guess_up(V, F) if up is None else up
    outline = V[ConvexHull(V).vertices]
    views = [view_of(outline, upward, _FRONT[0] + 360 * k / frames, _FRONT[1]) for k in range(frames)]
    widest = 1.06 * max(view.half for view in views)
    still = np.mean([view.centre for view in views], axis=0)
    pictures = [render(scene, View(view.eye, view.axes, still, widest), size) for view in views]
    some = np.hstack(pictures[:: max(1, frames // 4)])
    palette = Image.fromarray(some).quantize(256, method=Image.Quantize.MEDIANCUT)
    first, *rest = [
        Image.fromarray(picture).quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures
    ]
    first.save(path, save_all=True, append_images=rest, duration=_ONCE_AROUND // frames, loop=0)


def draw_whole(pieces: Sequence[Piece], size: int = 800, up: Floats | None = None) -> NDArray[np.uint8]:
    """Draw a puzzle from the side from which previews show it first.

    Parameters
    ----------
    pieces : sequence of Piece, at least one
    size : int, pixels along each side
    up : (3,) float64, unit; guessed where it is not given

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
    V, F, _, _ = concatenate(pieces)
    scene = scene_of_pieces(pieces)
    view = view_of(V, guess_up(V, F) if up is None else up, *_FRONT)
    return render(scene, View(view.eye, view.axes, view.centre, 1.08 * view.half), size)
