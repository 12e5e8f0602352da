"""Whether a curve has room where it stands: clear of borders, on even ground, its neck not too thin."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.cells.knobs.knob_borders import Borders, places_along
from meshjig.cells.knobs.knob_shapes import WAVE, Shapes
from meshjig.cells.knobs.surface_grid import Ground
from meshjig.mesh.measure import unit
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Curves", "Room", "cut_clean", "fits", "stood"]

_HALF_CHORD = 0.8  # of the border that a curve stands on, in half widths of its head
_MOST_BELOW = 4.0  # mm; curves reach half as far out of the cell at most
_UNDER = 0.95  # half of the stretch of border under a curve
_BULGE = 0.3  # of that stretch, at most
_OWN_BORDER = 1.1  # distance of the middle of a head from the border that it stands on
_SMALL_CLEAR = 0.7  # distance from other borders that does for a small curve
_MULTIPOINT = 4  # the number of that type of geometry


class Room(NamedTuple):
    """What curves must fit between, and how near they may come to it."""

    borders: Borders
    own: Any  # (e,) LineString, the sides
    others: Any  # (e,) LineString, the rest of their cells' borders
    rims: Any  # (l,) LineString, the loops around cells
    ground: Ground
    shapes: Shapes
    clear: float  # mm, distance from other borders, and between knobs
    least_neck: float  # mm


class Curves(NamedTuple):
    """Curves that stand on sides of borders."""

    side: Ints  # (c,)
    shape: Ints  # (c,), which of the shapes
    place: Floats  # (c,), along the loops
    middle: Floats  # (c, 2), mm, of the chord that the curve stands on
    x: Floats  # (c, 2), unit vectors along that chord, the cell to their left
    radius: Floats  # (c,), mm in the plane, half width of a head
    scale: Floats  # (c,), mm in space to 1 mm of the plane

    def take(self, which: Ints | Bools) -> "Curves":
        """Give some of them."""
        side, shape, place, middle, x, radius, scale = self
        return Curves(
            side[which], shape[which], place[which], middle[which], x[which], radius[which], scale[which]
        )

    def drawn(self, p: Floats) -> Floats:
        """Carry points (c, k, 2) of unit shapes to the plane."""
        y = np.stack([-self.x[:, 1], self.x[:, 0]], 1)
        outside = np.minimum(self.radius, _MOST_BELOW)[:, None]
        across = p[..., :1] * self.radius[:, None, None]
        up = p[..., 1] * np.where(p[..., 1] < 0, outside, self.radius[:, None])
        return self.middle[:, None] + across * self.x[:, None] + up[..., None] * y[:, None]


def stood(b: Borders, ground: Ground, side: Ints, place: Floats, shape: Ints, radius: Floats) -> Curves:
    """Stand curves on chords of their borders.

    Parameters
    ----------
    side : (c,) int64
    place : (c,) float64, along the loops
    shape : (c,) int64
    radius : (c,) float64, mm in the plane
    """
    left, right = (places_along(b, place + k * _HALF_CHORD * radius) for k in (-1, 1))
    middle = (left + right) / 2
    return Curves(side, shape, place, middle, unit(right - left), radius, ground.scale(middle))


def fits(room: Room, c: Curves) -> Bools:
    """Tell which curves have room, (c,) bool.

    A curve keeps its distance from the rest of the border of the cell that it enters, a small one
    somewhat less, and its head stays off the border that it stands on.
    """
    import shapely

    discs = room.shapes.discs[c.shape]
    centres = c.drawn(discs[..., :2])
    small = np.maximum(_SMALL_CLEAR * c.radius, room.least_neck / 2 / c.scale)
    clear = np.minimum(room.clear, small)
    neck = room.shapes.neck_width[c.shape] * c.radius * room.ground.scale(centres[:, 1])
    ok = (neck >= room.least_neck) & _on_even_ground(room.borders, c)
    for k in (2, 1, 0):
        on = np.flatnonzero(ok)
        far = shapely.distance(shapely.points(centres[on, k]), room.others[c.side[on]])
        ok[on] = ~(far < clear[on] + discs[on, k, 2] * c.radius[on])  # nan where nothing else is
    on = np.flatnonzero(ok & (room.shapes.kind[c.shape] != WAVE))
    far = shapely.distance(shapely.points(centres[on, 2]), room.own[c.side[on]])
    ok[on] = far >= _OWN_BORDER * c.radius[on]
    return ok


def cut_clean(room: Room, c: Curves) -> Bools:
    """Tell which curves cross the border of the cell that they enter at two feet and nowhere else."""
    import shapely

    curves = c.drawn(room.shapes.points[c.shape])
    loops = shapely.linestrings(np.concatenate([curves, curves[:, :1]], 1))
    met = shapely.intersection(loops, room.rims[room.borders.rim[c.side]])
    return (shapely.get_type_id(met) == _MULTIPOINT) & (shapely.get_num_geometries(met) == 2)


def _on_even_ground(b: Borders, c: Curves) -> Bools:
    """Tell where the border runs on under the whole curve, without turning back or bulging much."""
    offset = np.linspace(-_UNDER, _UNDER, 17)
    p = places_along(b, (c.place[:, None] + offset * c.radius[:, None]).ravel())
    d = p.reshape(-1, len(offset), 2) - c.middle[:, None]
    onward = np.diff(np.einsum("ckj,cj->ck", d, c.x), axis=1) > 0
    up = d[..., 1] * c.x[:, None, 0] - d[..., 0] * c.x[:, None, 1]
    low = _BULGE * np.minimum(c.radius, _MOST_BELOW)
    return onward.all(1) & (up.min(1) > -low) & (up.max(1) < _BULGE * c.radius)
