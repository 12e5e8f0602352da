"""What knobs and waves look like: unit curves, and the discs that stand for them in quick tests."""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.types import Floats, Ints

__all__ = ["SLIM", "STOUT", "WAVE", "KnobShapes", "knob_shapes"]

SLIM, STOUT, WAVE = 0, 1, 2  # kinds: a knob, one with a thick neck, and a bump without undercut
_VARIANTS = 12  # of a knob

# the half width of a head is 1; a neck is a hollow arc that touches the head's arc and flares below
_NECK = {SLIM: 0.54, STOUT: 0.68}  # half width
_HOLLOW = {SLIM: 0.45, STOUT: 0.36}  # radius of the hollow arc
_NECK_HEIGHT = 0.36
_FLARE = np.radians(55)  # how far that arc goes on below the neck
_FLAT = 0.85  # height of what is above the neck, to that of a round head
_BELOW, _BEYOND = -0.5, 0.18  # how far curves go on, down and out, where they have left the cell
_WAVE_WIDTH, _WAVE_HEIGHT, _WAVE_DEPTH = 1.06, 0.85, 0.10

_DISCS = np.array(  # x, y, radius
    [
        [[0.0, 0.0, 0.78], [0.0, 0.45, 0.60], [0.0, 1.25, 1.01]],
        [[0.0, 0.0, 0.84], [0.0, 0.45, 0.72], [0.0, 1.14, 1.01]],
        [[0.0, 0.0, 0.86], [0.0, 0.10, 0.72], [0.0, 0.20, 0.60]],
    ]
)


class KnobShapes(NamedTuple):
    """Unit curves over the x axis, half width of a knob's head 1, from the lower right to the lower left."""

    kind: Ints  # (s,)
    points: Floats  # (s, n, 2)
    discs: (
        Floats  # (s, 3, 3), x, y, radius; together they cover what is above the border, the last one the head
    )
    neck_width: Floats  # (s,), for a wave its width on the border
    half_width: Floats  # (s,), of the border that a curve takes up
    area: Floats  # (s,), above the border
    foot: int  # the point where a knob comes out of its border
    neck: tuple[int, int]  # the points on either side of a knob's neck
    head: tuple[int, int]  # and of its head, where it is widest

    def of_kind(self, kind: int) -> Ints:
        """List the shapes of a kind."""
        return np.flatnonzero(self.kind == kind)


def knob_shapes(rng: np.random.Generator, random: float, n: int) -> KnobShapes:
    """Draw variants of a slim and of a stout knob, and one wave.

    Parameters
    ----------
    rng : Generator
    random : float, 0 to 1, how far tops lean to a side and differ in height
    n : int, a curve has 4 n segments

    Returns
    -------
    KnobShapes
        The head of a slim knob is 1.85 times as wide as its neck, that of a stout one 1.47 times.
    """
    kind = np.append(np.repeat([SLIM, STOUT], _VARIANTS), WAVE)
    lean = (0.06 + 0.16 * random) * np.linspace(-1, 1, _VARIANTS)
    rise = 1 + (0.03 + 0.12 * random) * rng.permutation(np.linspace(-1, 1, _VARIANTS))
    skew, height = np.append(np.tile(lean, 2), 0.0), np.append(np.tile(rise, 2), 1.0)
    counts = _sections(n)
    curves = np.stack([_knob(SLIM, counts), _knob(STOUT, counts), _wave(n)])
    points = _bent(curves[kind], skew, height)
    radius = _DISCS[kind, :, 2] * np.maximum(1.0, height[:, None]) + 0.2 * np.abs(skew)[:, None]
    discs = np.concatenate([_bent(_DISCS[kind, :, :2], skew, height), radius[..., None]], -1)
    x, y = points[..., 0], np.maximum(points[..., 1], 0)
    first, widest = int(counts[0]), int(counts[:2].sum())
    return KnobShapes(
        kind=kind,
        points=points,
        discs=discs,
        neck_width=2 * np.array([_NECK[SLIM], _NECK[STOUT], 1.0])[kind],
        half_width=np.where(kind == WAVE, _WAVE_WIDTH, 1.0),
        area=-(np.diff(x, axis=1) * (y[:, 1:] + y[:, :-1]) / 2).sum(1),
        foot=int(np.argmax(curves[SLIM, :, 1] > -0.05)),
        neck=(first, 4 * n - first),
        head=(widest, 4 * n - widest),
    )


def _bent(p: Floats, skew: Floats, height: Floats) -> Floats:
    """Skew and stretch points (s, k, 2) above the neck."""
    rise = np.maximum(p[..., 1] - _NECK_HEIGHT, 0)
    x = p[..., 0] + skew[:, None] * np.minimum(rise / 1.5, 1)
    return np.stack([x, p[..., 1] + rise * (height[:, None] - 1)], -1)


def _sections(n: int) -> Ints:
    """Give how many of 2 n segments run up to the neck, to the widest place and to the top."""
    lengths = np.array([_length(part) for part in _half_knob(SLIM)])
    first, second = np.maximum(2, np.rint(2 * n * lengths[:2] / lengths.sum())).astype(np.int64)
    return np.array([first, second, 2 * n - first - second])


def _knob(kind: int, counts: Ints) -> Floats:
    half = [_even(part, count) for part, count in zip(_half_knob(kind), counts, strict=True)]
    return _mirrored(np.vstack([half[0], half[1][1:], half[2][1:]]))


def _half_knob(kind: int) -> list[Floats]:
    """Draw the right half of a knob: up to the neck, on to the widest place, and to the top."""
    neck, hollow = _NECK[kind], _HOLLOW[kind]
    beside = np.array([neck + hollow, _NECK_HEIGHT])
    middle = np.array([0.0, _NECK_HEIGHT + np.sqrt((1 + hollow) ** 2 - beside[0] ** 2)])
    meeting = np.arctan2(*(beside - middle)[::-1])  # where the two arcs touch, seen from the head
    flare = _arc(beside, hollow, np.pi + _FLARE, np.pi)
    below = np.vstack([[flare[0, 0] + _BEYOND, _BELOW], flare])
    rising = np.vstack([_arc(beside, hollow, np.pi, np.pi + meeting), _arc(middle, 1.0, meeting, 0.0)])
    over = _arc(middle, 1.0, 0.0, np.pi / 2)
    for part in (rising, over):
        part[:, 1] = _NECK_HEIGHT + _FLAT * (part[:, 1] - _NECK_HEIGHT)
    return [below, rising, over]


def _wave(n: int) -> Floats:
    x = np.linspace(_WAVE_WIDTH, 0, 200)
    y = _WAVE_HEIGHT * np.cos(np.pi / 2 * x / _WAVE_WIDTH) ** 2 - _WAVE_DEPTH
    return _mirrored(_even(np.vstack([[_WAVE_WIDTH, _BELOW], np.stack([x, y], 1)]), 2 * n))


def _mirrored(right: Floats) -> Floats:
    return np.vstack([right, right[-2::-1] * [-1, 1]])


def _arc(centre: Floats, radius: float, start: float, stop: float) -> Floats:
    t = np.linspace(start, stop, 100)
    return centre + radius * np.stack([np.cos(t), np.sin(t)], 1)


def _length(p: Floats) -> float:
    return float(np.linalg.norm(np.diff(p, axis=0), axis=1).sum())


def _even(p: Floats, n: int) -> Floats:
    """Divide a line into n parts of even length."""
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
    at = np.linspace(0, along[-1], n + 1)
    return np.stack([np.interp(at, along, p[:, k]) for k in (0, 1)], 1)
