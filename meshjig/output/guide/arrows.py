"""Arrows that show how pieces go in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import unit
from meshjig.output.guide.place_labels import Label
from meshjig.output.guide.proxy import JoinedPieces
from meshjig.output.pictures.view import View

__all__ = ["Arrows", "arrow_at", "arrow_shape", "arrows_of", "arrows_on_paper"]

_LENGTH = 0.16  # of the model's largest extent, from the piece on
_SHAFT, _HEAD, _DEEP = 0.55, 1.5, 2.3  # mm on paper: half the widths of shaft and head, length of the head
_SHORTEST = 22.0  # pixels
_CLEAR = 2.0  # pixels between an arrow and the number that it points at


class Arrows(NamedTuple):
    """Where the arrow of each piece ends and begins."""

    seat: Floats  # (p, 3), mm, the middle of its outer side
    start: Floats  # (p, 3), mm, outside, along the way out; the seat where no way is known

    @property
    def way(self) -> Floats:
        """Give where each goes out, (p, 3); zero where that is not known."""
        return unit(self.start - self.seat)


def arrows_of(joined: JoinedPieces, ways: Floats) -> Arrows:
    """Give for every piece an arrow towards its place, from outside all of it.

    Parameters
    ----------
    joined : JoinedPieces
    ways : (p, 3) float64, unit, in which pieces go out; zero where none is known

    Returns
    -------
    Arrows
    """
    V, F, piece_of_vertex, outer, _, _ = joined
    n = len(ways)
    corner = F[outer].ravel()
    owner = piece_of_vertex[corner]
    count = np.bincount(owner, minlength=n)
    mean = np.stack([np.bincount(owner, x, n) for x in V[corner].T], 1) / np.maximum(count, 1)[:, None]
    all_of = np.stack([np.bincount(piece_of_vertex, x, n) for x in V.T], 1)
    whole = all_of / np.maximum(np.bincount(piece_of_vertex, minlength=n), 1)[:, None]
    seat = np.where(count[:, None] > 0, mean, whole)
    reach = np.zeros(n)
    ahead = np.einsum("ij,ij->i", V - seat[piece_of_vertex], ways[piece_of_vertex])
    np.maximum.at(reach, piece_of_vertex, ahead)
    length = reach + _LENGTH * float(np.ptp(V, axis=0).max())
    return Arrows(seat, seat + length[:, None] * ways)


def arrows_on_paper(arrows: Arrows, some: Sequence[int], view: View, scale: float) -> Floats:
    """Give where from arrows come in a picture of so many pixels for 1 in the plane, (k, 2), pixels, y down.

    None is so short that it can't be seen, except zero for those that point straight at the eye.
    """
    seat, start = (view.on_plane(points[list(some)]) for points in (arrows.seat, arrows.start))
    along = (start - seat) * [scale, -scale]
    length = np.linalg.norm(along, axis=1)
    return unit(along) * np.where(length < 1, 0, np.maximum(length, _SHORTEST))[:, None]


def arrow_at(
    label: Label, size: tuple[float, float], along: Floats, picture: tuple[int, int]
) -> tuple[Floats, Floats] | None:
    """Let an arrow point at the number of a piece, or at where that number's line ends.

    Parameters
    ----------
    label : Label
    size : (float, float)
        Width and height of the number, pixels.
    along : (2,) float64, pixels, from the piece outward
    picture : (int, int)
        Width and height of the picture, which no arrow leaves.

    Returns
    -------
    (2,) float64 and (2,) float64, pixels
        Where it begins and where its tip is. None where it points straight at the eye.
    """
    length = float(np.hypot(*along))
    if length == 0:
        return None
    way, at = along / length, np.array(label.at if label.tip is None else label.tip)
    with np.errstate(divide="ignore"):
        leave = float((np.array(size) / 2 / np.abs(way)).min()) if label.tip is None else 0.0
        tip = at + (leave + _CLEAR) * way
        edge = np.where(way > 0, np.array(picture) - 1, 1) - tip
        room = float(np.where(way == 0, np.inf, edge / np.where(way == 0, 1, way)).min())
    return tip + min(max(length - leave, _SHORTEST) - _CLEAR, max(room, 1.0)) * way, tip


def arrow_shape(start: Sequence[float], tip: Sequence[float]) -> Floats:
    """Give the outline of an arrow on paper.

    Parameters
    ----------
    start, tip : (float, float), mm, apart

    Returns
    -------
    (7, 2) float64, mm
    """
    a, b = np.array(start, float), np.array(tip, float)
    along = unit(b - a)
    across = np.array([-along[1], along[0]])
    neck = b - min(_DEEP, 0.6 * float(np.linalg.norm(b - a))) * along
    sides = [
        (a, _SHAFT),
        (neck, _SHAFT),
        (neck, _HEAD),
        (b, 0.0),
        (neck, -_HEAD),
        (neck, -_SHAFT),
        (a, -_SHAFT),
    ]
    return np.array([at + wide * across for at, wide in sides])
