"""Where a knob could stand: places along each border, to either side, as large as obstacles let it be."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.cells.knobs.knob_borders import Borders, places_along
from meshjig.cells.knobs.knob_curves import MOST_BELOW, KnobCurves, placed
from meshjig.cells.knobs.knob_shapes import SLIM, STOUT, WAVE, KnobShapes
from meshjig.cells.knobs.surface_grid import SurfaceGrid
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = [
    "LARGEST",
    "Candidates",
    "KnobSpec",
    "Obstacles",
    "candidates",
    "cut_clean",
    "fits",
]

_UNDER = 0.95  # half of the stretch of border under a curve
_BULGE = 0.3  # of that stretch, at most
_OWN_BORDER = 1.1  # distance of the middle of a head from the border that it stands on
_SMALL_CLEAR = 0.7  # distance from other borders that does for a small curve
_MULTIPOINT = 4  # the number of that type of geometry
LARGEST = 0.185  # half width of a head, in units of s, the edge of a square as large as a cell
_SMALLEST = 0.04
_STEPS = (1.0, 0.92, 0.84, 0.76, 0.68, 0.6, 0.525, 0.46, 0.4, 0.35, 0.3, 0.255, 0.216)
_SMALLER = (1.0, 0.8, 0.64)  # what fits is offered smaller too, for where knobs compete
_PLACES = 7  # tried along a border
_SPARE_NECK = 1.02
_WORTH_STOUT = 0.5  # of the largest knob: where the least neck asks for more, stout ones help


class Obstacles(NamedTuple):
    """What curves must fit between, and how near they may come to it."""

    borders: Borders
    own: Any  # (e,) LineString, the sides
    others: Any  # (e,) LineString, the rest of their cells' borders
    rims: Any  # (l,) LineString, the loops around cells
    grid: SurfaceGrid
    shapes: KnobShapes
    clear: float  # mm, distance from other borders, and between knobs
    least_neck: float  # mm


def fits(obstacles: Obstacles, c: KnobCurves) -> Bools:
    """Tell which curves have room, (c,) bool.

    A curve keeps its distance from the rest of the border of the cell that it enters, a small one
    somewhat less, and its head stays off the border that it stands on.
    """
    import shapely

    discs = obstacles.shapes.discs[c.shape]
    centres = c.drawn(discs[..., :2])
    small = np.maximum(_SMALL_CLEAR * c.radius, obstacles.least_neck / 2 / c.scale)
    clear = np.minimum(obstacles.clear, small)
    neck = obstacles.shapes.neck_width[c.shape] * c.radius * obstacles.grid.scale(centres[:, 1])
    ok = (neck >= obstacles.least_neck) & _on_even_ground(obstacles.borders, c)
    for k in (2, 1, 0):
        on = np.flatnonzero(ok)
        far = shapely.distance(shapely.points(centres[on, k]), obstacles.others[c.side[on]])
        ok[on] = ~(far < clear[on] + discs[on, k, 2] * c.radius[on])  # nan where nothing else is
    on = np.flatnonzero(ok & (obstacles.shapes.kind[c.shape] != WAVE))
    far = shapely.distance(shapely.points(centres[on, 2]), obstacles.own[c.side[on]])
    ok[on] = far >= _OWN_BORDER * c.radius[on]
    return ok


def cut_clean(obstacles: Obstacles, c: KnobCurves) -> Bools:
    """Tell which curves cross the border of the cell that they enter at two feet and nowhere else."""
    import shapely

    curves = c.drawn(obstacles.shapes.points[c.shape])
    loops = shapely.linestrings(np.concatenate([curves, curves[:, :1]], 1))
    met = shapely.intersection(loops, obstacles.rims[obstacles.borders.rim[c.side]])
    return (shapely.get_type_id(met) == _MULTIPOINT) & (shapely.get_num_geometries(met) == 2)


def _on_even_ground(b: Borders, c: KnobCurves) -> Bools:
    """Tell where the border runs on under the whole curve, without turning back or bulging much."""
    offset = np.linspace(-_UNDER, _UNDER, 17)
    p = places_along(b, (c.place[:, None] + offset * c.radius[:, None]).ravel())
    d = p.reshape(-1, len(offset), 2) - c.middle[:, None]
    onward = np.diff(np.einsum("ckj,cj->ck", d, c.x), axis=1) > 0
    up = d[..., 1] * c.x[:, None, 0] - d[..., 0] * c.x[:, None, 1]
    low = _BULGE * np.minimum(c.radius, MOST_BELOW)
    return onward.all(1) & (up.min(1) > -low) & (up.max(1) < _BULGE * c.radius)


class KnobSpec(NamedTuple):
    """How knobs shall be."""

    s: float  # mm, edge of a square as large as a cell
    size: float  # relative to the usual
    random: float  # 0 to 1


class Candidates(NamedTuple):
    """Curves that fit where they stand."""

    curves: KnobCurves
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


def candidates(
    obstacles: Obstacles, spec: KnobSpec, rng: np.random.Generator, asked: Bools | None = None
) -> Candidates:
    """List knobs and waves that fit, at several places on both sides of every border, or on the sides asked.

    Stout knobs are among them only where a slim one's neck would soon be too thin.
    """
    b = obstacles.borders
    n = len(b.cell)
    asked = np.ones(n, bool) if asked is None else asked
    at = np.tile((np.arange(_PLACES) + 0.5) / _PLACES, n)
    at = at + rng.uniform(-0.25, 0.25, len(at)) * (0.2 + 0.8 * spec.random) / _PLACES
    variant = rng.integers(0, 1 << 30, len(b.sides))[b.border]
    vary = 1 - 0.3 * spec.random * rng.random(len(b.sides))[b.border]
    kinds = [SLIM, STOUT, WAVE]
    if obstacles.least_neck < _WORTH_STOUT * LARGEST * spec.s * obstacles.shapes.neck_width[0]:
        kinds.remove(STOUT)
    parts = []
    for kind in kinds:
        shapes = obstacles.shapes.of_kind(kind)
        shape = shapes[variant % len(shapes)]
        parts += _largest(obstacles, _places(obstacles, spec, at, shape, vary), asked)
    curves = KnobCurves(*(np.concatenate(values) for values in zip(*(c for c, *_ in parts), strict=True)))
    return Candidates(curves, *(np.concatenate(values) for values in list(zip(*parts, strict=True))[1:]))


def _places(obstacles: Obstacles, spec: KnobSpec, at: Floats, shape: Ints, vary: Floats) -> _Places:
    """Prepare the places at (e * _PLACES,) for a shape of each side."""
    b = obstacles.borders
    side = np.repeat(np.arange(len(b.cell)), _PLACES)
    shape, mm = shape[side], b.mm()[side]
    scale = obstacles.grid.scale(places_along(b, b.along[b.span[side, 0]] + at * mm))
    neck = _SPARE_NECK * obstacles.least_neck / obstacles.shapes.neck_width[shape]
    least = np.maximum(_SMALLEST * spec.s, neck) / scale
    largest = LARGEST * spec.s * spec.size * vary[side] / scale
    ends = np.minimum(at, 1 - at) * mm / obstacles.shapes.half_width[shape]
    return _Places(side, at, shape, largest, least, ends)


def _largest(obstacles: Obstacles, places: _Places, asked: Bools) -> list[tuple[KnobCurves, Floats, Ints]]:
    """Give the largest curves that fit at places, and smaller ones there."""
    todo = places.take(asked[places.side] & (places.ends >= places.least) & (places.largest >= places.least))
    parts = []
    for step in _STEPS:
        radius = np.maximum(step * todo.largest, todo.least)
        fit = radius <= todo.ends
        fit[fit] = fits(obstacles, _curves(obstacles, todo.take(fit), radius[fit]))
        for rank, smaller in enumerate(_SMALLER):
            enough = fit & (smaller * radius >= todo.least)
            made = _curves(obstacles, todo.take(enough), smaller * radius[enough])
            off = np.abs(2 * todo.at[enough] - 1)
            ok = fits(obstacles, made) if rank else np.ones(len(off), bool)
            parts.append((made.take(ok), off[ok], np.full(int(ok.sum()), rank)))
        todo = todo.take(~fit)
    return parts


def _curves(obstacles: Obstacles, places: _Places, radius: Floats) -> KnobCurves:
    b = obstacles.borders
    place = b.along[b.span[places.side, 0]] + places.at * b.mm()[places.side]
    return placed(b, obstacles.grid, places.side, place, places.shape, radius)
