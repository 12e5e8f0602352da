"""Where numbers go in a picture: on their piece where it has room, else beside it, with a line to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints

__all__ = ["Label", "place_labels"]

_LEAST = 24  # visible pixels below which a piece is not pointed at
_TURNS = 24  # directions in which room is looked for beside a piece
_FAR = 12  # distances
_ON_ARROW, _WIDE = np.linspace(0.3, 1, 8), 4.0  # pixels around the outer part of an arrow are taken


@dataclass(frozen=True)
class Label:
    """The number of a piece in a picture."""

    piece: int  # counted from 0
    at: tuple[float, float]  # its middle, pixels, x to the right, y down
    tip: tuple[float, float] | None  # where its line ends, if it is not on its piece


def place_labels(
    piece: Ints,
    new: Sequence[int],
    size: Sequence[tuple[float, float]],
    along: Sequence[Floats] | None = None,
) -> list[Label]:
    """Find room for the numbers of the new pieces.

    Parameters
    ----------
    piece : (h, w) int64
        Whose each pixel is, counted from 0; -1 is paper.
    new : sequence of int
        The pieces that get a number.
    size : sequence of (float, float)
        Width and height of each number, pixels.
    along : sequence of (2,) float64, optional
        Arrows that begin so far from each piece, pixels; numbers leave them room.

    Returns
    -------
    list of Label
        None overlaps another. Pieces that are not seen have none.
    """
    taken: list[Floats] = []
    labels: list[Label] = []
    spots = [_widest(piece == one) for one in new]
    arrows = [_on_arrow(spot, arrow) for spot, arrow in zip(spots, along or [], strict=along is not None)]
    crowd = [_summed(np.isin(piece, list(new))), _summed(piece >= 0)]
    order = sorted(range(len(new)), key=lambda i: -spots[i][2])
    for i in order:
        x, y, room = spots[i]
        if room <= 0:
            continue
        w, h = size[i]
        box = np.array([x - w / 2, y - h / 2, x + w / 2, y + h / 2])
        others = [boxes for j, arrow in enumerate(arrows) if j != i for boxes in arrow]
        if room >= 0.5 * np.hypot(0.8 * w, h) and not _hits(box, taken + others):
            labels.append(Label(new[i], (x, y), None))
        else:
            box = _beside(x, y, w, h, crowd, [*taken, *chain.from_iterable(arrows)])
            middle = (float(box[0] + box[2]) / 2, float(box[1] + box[3]) / 2)
            labels.append(Label(new[i], middle, (x, y)))
        taken.append(box)
    return sorted(labels, key=lambda label: label.piece)


def _on_arrow(spot: tuple[float, float, float], along: Floats) -> list[Floats]:
    """Boxes over the arrow that points at a spot; none where its piece is not seen."""
    x, y, room = spot
    middles = [x, y] + _ON_ARROW[:, None] * along
    return list(np.hstack([middles - _WIDE, middles + _WIDE])) if room > 0 else []


def _widest(mask: Bools) -> tuple[float, float, float]:
    """The middle and radius of the largest circle within a mask, radius 0 for a mere speck."""
    from scipy.ndimage import distance_transform_edt

    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if not len(rows):
        return 0.0, 0.0, 0.0
    top, left = int(rows[0]), int(columns[0])
    part = mask[top : rows[-1] + 1, left : columns[-1] + 1]
    if np.count_nonzero(part) < _LEAST:
        return 0.0, 0.0, 0.0
    room = distance_transform_edt(np.pad(part, 1))
    row, column = np.unravel_index(int(room.argmax()), room.shape)
    return float(left + column) - 0.5, float(top + row) - 0.5, float(room[row, column])


def _hits(box: Floats, taken: list[Floats]) -> bool:
    return bool(taken) and bool(_overlaps(box[None], taken)[0])


def _overlaps(boxes: Floats, taken: list[Floats]) -> Bools:
    """Tell which boxes (k, 4) overlap one that is taken, (k,)."""
    if not taken:
        return np.zeros(len(boxes), bool)
    b, t = boxes[:, None], np.array(taken)[None]
    apart: Bools = np.any((b[..., 2:] <= t[..., :2]) | (b[..., :2] >= t[..., 2:]), axis=2)
    return np.any(~apart, axis=1)


def _beside(x: float, y: float, w: float, h: float, crowd: list[Ints], taken: list[Floats]) -> Floats:
    """The best box near a point: free, near, off the new pieces, and rather off the model too."""
    turn, far = np.meshgrid(
        2 * np.pi * np.arange(_TURNS) / _TURNS, (1.0 + 0.5 * np.arange(_FAR)) * (w + h) / 2
    )
    at = np.stack([x + (far * np.cos(turn)).ravel(), y + (far * np.sin(turn)).ravel()], 1)
    half = np.array([w, h]) / 2
    frame = np.array(crowd[0].shape)[::-1] - 1
    at = np.clip(at, half, frame - half)
    boxes = np.hstack([at - half, at + half])
    cost = np.hypot(*(at - (x, y)).T) / (w + h)
    cost += 3.0 * _share(crowd[0], boxes) + 0.8 * _share(crowd[1], boxes)
    cost += 100.0 * _overlaps(boxes, taken) + 100.0 * (np.abs(at - (x, y)) < half).all(axis=1)
    best: Floats = boxes[int(cost.argmin())]
    return best


def _summed(mask: Bools) -> Ints:
    """Count what is set above and to the left of each corner, (h + 1, w + 1)."""
    total = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), np.int64)
    np.cumsum(np.cumsum(mask, axis=0, dtype=np.int64), axis=1, out=total[1:, 1:])
    return total


def _share(total: Ints, boxes: Floats) -> Floats:
    """How much of each box (k, 4) is set, (k,)."""
    most = np.array(total.shape)[[1, 0, 1, 0]] - 1
    left, top, right, bottom = np.clip(np.rint(boxes).astype(np.int64), 0, most).T
    inside = total[bottom, right] - total[top, right] - total[bottom, left] + total[top, left]
    return inside / np.maximum((right - left) * (bottom - top), 1)
