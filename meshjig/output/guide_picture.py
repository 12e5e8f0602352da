"""Small pictures of a step: what is there in pale grey, new pieces hatched and with dark borders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.output.light import light_of
from meshjig.output.scene import Scene, cast
from meshjig.output.srgb import to_srgb
from meshjig.output.view import View
from meshjig.types import Bools, Floats, Ints

__all__ = ["Frame", "Picture", "draw_step", "silhouette"]

Floats32 = NDArray[np.float32]

_COARSE = 4  # pixels between the rays that find out where the model is
_PLACED = (0.90, 0.90, 0.90)  # sRGB in full light
_NEW = (1.00, 0.80, 0.42)
_GHOST = 0.955  # sRGB of the model to be
_GHOST_LINE = 0.84
_THIN, _BOLD = 0.55, 0.95  # how black borders are between pieces, and around new ones
_HATCH, _STROKE, _PERIOD = 0.30, 0.9, 9  # how black; pixels
_JUMP = 0.02  # in depth, radii of the model: what is behind begins


class Frame(NamedTuple):
    """A rectangle of pixels around the middle of a view."""

    width: int  # pixels
    height: int
    scale: float  # pixels for 1 in the plane at distance 1

    def square(self, view: View) -> tuple[View, int, int, int]:
        """Give the view of the square around it, its size, and where the rectangle begins."""
        size = max(self.width, self.height)
        around = View(view.eye, view.axes, view.centre, size / (2 * self.scale))
        return around, size, (size - self.width) // 2, (size - self.height) // 2


@dataclass(frozen=True)
class Picture:
    """What was drawn, and whose pixels are whose."""

    rgb: NDArray[np.uint8]  # (height, width, 3)
    piece: Ints  # (height, width), counted from 0; -1 is paper


def silhouette(scene: Scene, view: View, frame: Frame) -> Bools:
    """Find out where a model is in a picture, (height, width), in steps of two pixels."""
    from scipy.ndimage import binary_closing

    around, size, left, top = frame.square(view)
    rows, columns = np.mgrid[0 : frame.height : 2, 0 : frame.width : 2] + 1.0
    hits = cast(scene, around, size, columns.ravel() + left, rows.ravel() + top)
    found = binary_closing(np.pad((hits.id >= 0).reshape(rows.shape), 2), iterations=2)[2:-2, 2:-2]  # no gaps
    return found.repeat(2, 0).repeat(2, 1)[: frame.height, : frame.width]


def draw_step(scene: Scene, view: View, frame: Frame, new: Sequence[int], ghost: Bools) -> Picture:
    """Draw a step.

    Parameters
    ----------
    scene : Scene
        What is there; ids are pieces, counted from 0.
    view : View
    frame : Frame
    new : sequence of int, the pieces that come new
    ghost : (height, width) bool, where the model will be

    Returns
    -------
    Picture
    """
    around, size, left, top = frame.square(view)
    row, column = np.nonzero(_worth_a_ray(scene, around, size, frame, left, top))
    hits = cast(scene, around, size, column + left + 0.5, row + top + 0.5)
    sky = np.ones(len(row), np.float32)
    light = light_of(scene, around, hits, sky)[hits.ray, 1]
    piece = np.full((frame.height, frame.width), -1)
    piece[row, column] = hits.id
    depth = np.zeros(piece.shape, np.float32)
    depth[row, column] = hits.depth
    is_new = np.zeros(int(scene.id.max(initial=0)) + 2, bool)  # the last is the paper's
    is_new[list(new)] = True

    rgb = np.ones((*piece.shape, 3), np.float32)
    rgb[ghost] = _GHOST
    rgb[_outline(ghost)] = _GHOST_LINE
    mine = is_new[hits.id[hits.ray]]
    tint = np.where(mine[:, None], np.array(_NEW, np.float32), np.array(_PLACED, np.float32))
    at = row[hits.ray], column[hits.ray]
    rgb[at] = tint * _tone(light)[:, None]
    new_pixel = np.append(is_new[:-1], False)[piece]
    ink = _ink(piece, depth, new_pixel)
    rgb *= (1 - ink)[..., None]
    return Picture(np.rint(255 * np.clip(rgb, 0, 1)).astype(np.uint8), piece)


def _worth_a_ray(scene: Scene, view: View, size: int, frame: Frame, left: int, top: int) -> Bools:
    """Mark the pixels around those of a coarse grid that show something."""
    from scipy.ndimage import binary_dilation

    half = _COARSE / 2
    rows, columns = np.mgrid[half : frame.height + half : _COARSE, half : frame.width + half : _COARSE]
    hits = cast(scene, view, size, columns.ravel() + left, rows.ravel() + top)
    near = binary_dilation((hits.id >= 0).reshape(rows.shape), np.ones((3, 3), bool))
    return near.repeat(_COARSE, 0).repeat(_COARSE, 1)[: frame.height, : frame.width]


def _tone(light: Floats32) -> Floats32:
    """Give how bright light looks, with little contrast, so that numbers can be read on it."""
    ramp = to_srgb(np.linspace(0, 1, 1024)).astype(np.float32)
    return 0.35 + 0.65 * ramp[(np.clip(light, 0, 1) * 1023).astype(np.int64)]


def _outline(inside: Bools) -> Bools:
    line = np.zeros(inside.shape, bool)
    line[1:] |= inside[1:] != inside[:-1]
    line[:, 1:] |= inside[:, 1:] != inside[:, :-1]
    return line


def _ink(piece: Ints, depth: Floats32, new: Bools) -> Floats32:
    """Give how black borders and hatching make each pixel, 0 to 1."""
    thin, bold = np.zeros(piece.shape, np.float32), np.zeros(piece.shape, np.float32)
    for p, d, n, fine, strong in (
        (piece, depth, new, thin, bold),
        (piece.T, depth.T, new.T, thin.T, bold.T),
    ):
        border = p[1:] != p[:-1]
        fine[1:] += border
        fine[1:-1] += np.abs(d[2:] - 2 * d[1:-1] + d[:-2]) > _JUMP
        edge = border & (n[1:] | n[:-1])
        strong[1:] += edge
        strong[:-1] += edge
    ink = np.maximum(_THIN * _soft(thin), _BOLD * _soft(bold))
    row, column = np.nonzero(new)
    away = np.abs((row + column) % _PERIOD - _PERIOD // 2)
    stroke = np.clip(_STROKE + 0.5 - away, 0, 1).astype(np.float32)
    ink[row, column] = np.maximum(ink[row, column], _HATCH * stroke)
    return ink


def _soft(line: Floats32) -> Floats32:
    """Blur a line of pixels a little, so that its steps don't show."""
    line = np.minimum(line, 1)
    for x in (line, line.T):
        x[1:-1] = 0.5 * x[1:-1] + 0.25 * (x[2:] + x[:-2])
    return np.minimum(1.4 * line, 1)
