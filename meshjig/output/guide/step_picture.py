"""Small pictures of a step: what is there in pale grey, new pieces hatched and with dark borders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import unit
from meshjig.mesh.rays import Floats32
from meshjig.output.guide.proxy import PlacedFaces, meet
from meshjig.output.pictures.view import View

__all__ = ["Frame", "StepPicture", "draw_step", "silhouette"]

_ROUGH = 3  # pixels between the rays that find a silhouette
_COARSE = 4  # pixels between the rays that find out where the model is
_PLACED = (0.91, 0.91, 0.91)  # sRGB in full light
_NEW = (1.00, 0.80, 0.42)
_GHOST = np.float32(0.95)  # sRGB of the model to be
_SOFT = 30  # pixels from the border of a picture within which the model to be fades out
_LAMP = (-0.45, 0.65, -0.62)  # towards it, in the eye's right, up, forward
_THIN, _BOLD = 0.55, 0.95  # how black borders are between pieces, and around new ones
_HATCH, _STROKE, _PERIOD = 0.30, 0.7, 7  # how black; pixels
_JUMP = 0.02  # in depth, radii of the model: what is behind begins


class Frame(NamedTuple):
    """A rectangle of pixels in the plane at distance 1."""

    width: int  # pixels
    height: int
    scale: float  # pixels for 1 in the plane
    middle: tuple[float, float]  # in the plane

    def plane(self, column: Floats, row: Floats) -> tuple[Floats, Floats]:
        """Give the places of pixels in the plane; the middle of the first is at 0.5, 0.5."""
        x = self.middle[0] + (column - self.width / 2) / self.scale
        return x, self.middle[1] - (row - self.height / 2) / self.scale


@dataclass(frozen=True)
class StepPicture:
    """What was drawn, and whose pixels are whose."""

    rgb: NDArray[np.uint8]  # (height, width, 3)
    piece: Ints  # (height, width), counted from 0; -1 is paper


def silhouette(placed: PlacedFaces, view: View, frame: Frame) -> Bools:
    """Find out where a model is in a picture, (height, width), roughly."""
    from scipy.ndimage import binary_closing

    found = np.pad(_grid(placed, view, frame, _ROUGH), 2)
    found = binary_closing(found, iterations=2)[2:-2, 2:-2]  # rays slip through between pieces
    return found.repeat(_ROUGH, 0).repeat(_ROUGH, 1)[: frame.height, : frame.width]


def draw_step(placed: PlacedFaces, view: View, frame: Frame, new: Sequence[int], ghost: Bools) -> StepPicture:
    """Draw a step.

    Parameters
    ----------
    placed : PlacedFaces, what is there
    view : View
    frame : Frame
    new : sequence of int, the pieces that come new, counted from 0
    ghost : (height, width) bool, where the model will be

    Returns
    -------
    StepPicture
    """
    from scipy.ndimage import uniform_filter

    scene = placed.scene
    row, column = np.nonzero(_worth_a_ray(placed, view, frame))
    x, y = frame.plane(column.astype(np.float64) + 0.5, row.astype(np.float64) + 0.5)
    met = meet(placed, view.eye, view.rays(x, y))
    hit = np.flatnonzero(met.face >= 0)
    row, column, face = row[hit], column[hit], met.face[hit]
    piece = np.full(ghost.shape, -1)
    piece[row, column] = scene.id[face]
    depth = np.zeros(ghost.shape, np.float32)
    depth[row, column] = met.depth[hit]
    is_new = np.zeros(int(scene.id.max(initial=0)) + 2, bool)  # the last is the paper's
    is_new[list(new)] = True
    fresh = is_new[piece]

    rgb = np.ones((*ghost.shape, 3), np.float32)
    rgb -= ((1 - _GHOST) * uniform_filter(ghost.astype(np.float32), 7) * _fade(ghost.shape))[..., None]
    shade = _shade(scene.normal, view)[scene.corner[face]]
    light = np.einsum("ij,ij->i", shade, met.corner[hit])
    tint = np.array([_PLACED, _NEW], np.float32)[fresh[row, column].astype(np.int64)]
    rgb[row, column] = tint * light[:, None]
    rgb *= (1 - _ink(piece, depth, fresh))[..., None]
    return StepPicture(np.rint(255 * np.clip(rgb, 0, 1)).astype(np.uint8), piece)


def _grid(placed: PlacedFaces, view: View, frame: Frame, step: int) -> Bools:
    """Tell where there is something, for every so many pixels."""
    rows, columns = np.mgrid[0 : frame.height : step, 0 : frame.width : step] + step / 2
    met = meet(placed, view.eye, view.rays(*frame.plane(columns.ravel(), rows.ravel())))
    found: Bools = (met.face >= 0).reshape(rows.shape)
    return found


def _worth_a_ray(placed: PlacedFaces, view: View, frame: Frame) -> Bools:
    """Mark the pixels around those of a coarse grid that show something."""
    from scipy.ndimage import binary_dilation

    near = binary_dilation(_grid(placed, view, frame, _COARSE), np.ones((3, 3), bool))
    return near.repeat(_COARSE, 0).repeat(_COARSE, 1)[: frame.height, : frame.width]


def _shade(normal: Floats32, view: View) -> Floats32:
    """How bright vertices look, (n,): with little contrast, so that numbers can be read on them."""
    lamp = (unit(np.array(_LAMP)) @ view.axes).astype(np.float32)
    toward_eye, up = -view.axes[2].astype(np.float32), view.axes[1].astype(np.float32)
    lit = np.clip(normal @ lamp, 0, 1)
    shade = 0.64 + 0.20 * lit + 0.14 * np.clip(normal @ toward_eye, 0, 1) + 0.06 * (normal @ up)
    return np.minimum(shade, 1).astype(np.float32)


def _fade(shape: tuple[int, ...]) -> Floats32:
    """Give 0 at the border of a picture, rising to 1 some way within."""
    y, x = (np.minimum(np.arange(n), np.arange(n)[::-1]).astype(np.float32) / _SOFT for n in shape)
    return np.minimum(np.minimum(y[:, None], x), 1)


def _ink(piece: Ints, depth: Floats32, fresh: Bools) -> Floats32:
    """How black borders and hatching make each pixel, 0 to 1."""
    thin, bold = np.zeros(piece.shape, np.float32), np.zeros(piece.shape, np.float32)
    for p, d, n, fine, strong in (
        (piece, depth, fresh, thin, bold),
        (piece.T, depth.T, fresh.T, thin.T, bold.T),
    ):
        border = p[1:] != p[:-1]
        fine[1:] += border
        fine[1:-1] += np.abs(d[2:] - 2 * d[1:-1] + d[:-2]) > _JUMP
        edge = border & (n[1:] | n[:-1])
        strong[1:] += edge
        strong[:-1] += edge
    ink = np.maximum(_THIN * _soft(thin), _BOLD * _soft(bold))
    row, column = np.nonzero(fresh)
    away = np.abs((row + column) % _PERIOD - _PERIOD // 2)
    stroke = _HATCH * np.clip(_STROKE + 0.5 - away, 0, 1).astype(np.float32)
    ink[row, column] = np.maximum(ink[row, column], stroke)
    return ink


def _soft(line: Floats32) -> Floats32:
    """Blur a line of pixels a little, so that its steps don't show."""
    line = np.minimum(line, 1)
    for x in (line, line.T):
        x[1:-1] = 0.5 * x[1:-1] + 0.25 * (x[2:] + x[:-2])
    return np.minimum(1.4 * line, 1)
