"""Where a knob could stand: places along each border, to either side, as large as there is room."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.knobs.knob_borders import places_along
from meshjig.cells.knobs.knob_obstacles import Curves, Room, fits, stood
from meshjig.cells.knobs.knob_shapes import SLIM, STOUT, WAVE
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["LARGEST", "Candidates", "Wish", "candidates"]

LARGEST = 0.185  # half width of a head, in units of s, the edge of a square as large as a cell
_SMALLEST = 0.04
_STEPS = (1.0, 0.92, 0.84, 0.76, 0.68, 0.6, 0.525, 0.46, 0.4, 0.35, 0.3, 0.255, 0.216)
_SMALLER = (1.0, 0.8, 0.64)  # what fits is offered smaller too, for where knobs compete
_PLACES = 7  # tried along a border
_SPARE_NECK = 1.02
_WORTH_STOUT = 0.5  # of the largest knob: where the least neck asks for more, stout ones help


class Wish(NamedTuple):
    """How knobs shall be."""

    s: float  # mm, edge of a square as large as a cell
    size: float  # relative to the usual
    random: float  # 0 to 1


class Candidates(NamedTuple):
    """Curves that fit where they stand."""

    curves: Curves
    off: Floats  # (c,), 0 in the middle of the border to 1 at its ends
    rank: Ints  # (c,), 0 for the largest that fits there, 1 and 2 for smaller ones

    def take(self, which: Ints | Bools) -> "Candidates":
        """Give some of them."""
        return Candidates(self.curves.take(which), self.off[which], self.rank[which])


class _Places(NamedTuple):
    side: Ints  # (k,)
    at: Floats  # (k,), 0 to 1 along the side
    shape: Ints  # (k,)
    largest: Floats  # (k,), half width of a head, mm in the plane
    least: Floats  # (k,)
    ends: Floats  # (k,), what the distance to the nearer end of the side allows

    def take(self, which: Ints | Bools) -> "_Places":
        side, at, shape, largest, least, ends = self
        return _Places(side[which], at[which], shape[which], largest[which], least[which], ends[which])


def candidates(room: Room, wish: Wish, rng: np.random.Generator, asked: Bools | None = None) -> Candidates:
    """List knobs and waves that fit, at several places on both sides of every border, or on the sides asked.

    Stout knobs are among them only where a slim one's neck would soon be too thin.
    """
    b = room.borders
    n = len(b.cell)
    asked = np.ones(n, bool) if asked is None else asked
    at = np.tile((np.arange(_PLACES) + 0.5) / _PLACES, n)
    at = at + rng.uniform(-0.25, 0.25, len(at)) * (0.2 + 0.8 * wish.random) / _PLACES
    variant = rng.integers(0, 1 << 30, len(b.sides))[b.border]
    vary = 1 - 0.3 * wish.random * rng.random(len(b.sides))[b.border]
    kinds = [SLIM, STOUT, WAVE]
    if room.least_neck < _WORTH_STOUT * LARGEST * wish.s * room.shapes.neck_width[0]:
        kinds.remove(STOUT)
    parts = []
    for kind in kinds:
        shapes = room.shapes.of_kind(kind)
        shape = shapes[variant % len(shapes)]
        parts += _largest(room, _places(room, wish, at, shape, vary), asked)
    curves = Curves(*(np.concatenate(values) for values in zip(*(c for c, *_ in parts), strict=True)))
    return Candidates(curves, *(np.concatenate(values) for values in list(zip(*parts, strict=True))[1:]))


def _places(room: Room, wish: Wish, at: Floats, shape: Ints, vary: Floats) -> _Places:
    """Prepare the places at (e * _PLACES,) for a shape of each side."""
    b = room.borders
    side = np.repeat(np.arange(len(b.cell)), _PLACES)
    shape, mm = shape[side], b.mm()[side]
    scale = room.ground.scale(places_along(b, b.along[b.span[side, 0]] + at * mm))
    neck = _SPARE_NECK * room.least_neck / room.shapes.neck_width[shape]
    least = np.maximum(_SMALLEST * wish.s, neck) / scale
    largest = LARGEST * wish.s * wish.size * vary[side] / scale
    ends = np.minimum(at, 1 - at) * mm / room.shapes.half_width[shape]
    return _Places(side, at, shape, largest, least, ends)


def _largest(room: Room, places: _Places, asked: Bools) -> list[tuple[Curves, Floats, Ints]]:
    """Give the largest curves that fit at places, and smaller ones there."""
    todo = places.take(asked[places.side] & (places.ends >= places.least) & (places.largest >= places.least))
    parts = []
    for step in _STEPS:
        radius = np.maximum(step * todo.largest, todo.least)
        fit = radius <= todo.ends
        fit[fit] = fits(room, _curves(room, todo.take(fit), radius[fit]))
        for rank, smaller in enumerate(_SMALLER):
            enough = fit & (smaller * radius >= todo.least)
            made = _curves(room, todo.take(enough), smaller * radius[enough])
            off = np.abs(2 * todo.at[enough] - 1)
            ok = fits(room, made) if rank else np.ones(len(off), bool)
            parts.append((made.take(ok), off[ok], np.full(int(ok.sum()), rank)))
        todo = todo.take(~fit)
    return parts


def _curves(room: Room, places: _Places, radius: Floats) -> Curves:
    b = room.borders
    place = b.along[b.span[places.side, 0]] + places.at * b.mm()[places.side]
    return stood(b, room.ground, places.side, place, places.shape, radius)
