"""Curves of knobs and waves where they stand, and as cuts through the plane: closed loops with labels."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.knobs.knob_borders import Borders, places_along
from meshjig.cells.knobs.knob_shapes import WAVE, KnobShapes
from meshjig.cells.knobs.surface_grid import SurfaceGrid
from meshjig.mesh.arrays import next_in_loop
from meshjig.mesh.measure import unit
from meshjig.mesh.types import Bools, Floats, Ints, Knobs, Outlines

__all__ = ["MOST_BELOW", "KnobCurves", "knob_loops", "placed"]

_HALF_CHORD = 0.8  # of the border that a curve stands on, in half widths of its head
MOST_BELOW = 4.0  # mm; curves reach half as far out of the cell at most
_AROUND = 0.3  # mm from a cell to the frame around it


class KnobCurves(NamedTuple):
    """Curves that stand on sides of borders."""

    side: Ints  # (c,)
    shape: Ints  # (c,), which of the shapes
    place: Floats  # (c,), along the loops
    middle: Floats  # (c, 2), mm, of the chord that the curve stands on
    x: Floats  # (c, 2), unit vectors along that chord, the cell to their left
    radius: Floats  # (c,), mm in the plane, half width of a head
    scale: Floats  # (c,), mm in space to 1 mm of the plane

    def take(self, which: Ints | Bools) -> "KnobCurves":
        """Give some of them."""
        side, shape, place, middle, x, radius, scale = self
        return KnobCurves(
            side[which], shape[which], place[which], middle[which], x[which], radius[which], scale[which]
        )

    def drawn(self, p: Floats) -> Floats:
        """Carry points (c, k, 2) of unit shapes to the plane."""
        y = np.stack([-self.x[:, 1], self.x[:, 0]], 1)
        outside = np.minimum(self.radius, MOST_BELOW)[:, None]
        across = p[..., :1] * self.radius[:, None, None]
        up = p[..., 1] * np.where(p[..., 1] < 0, outside, self.radius[:, None])
        return self.middle[:, None] + across * self.x[:, None] + up[..., None] * y[:, None]


def placed(
    b: Borders, grid: SurfaceGrid, side: Ints, place: Floats, shape: Ints, radius: Floats
) -> KnobCurves:
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
    return KnobCurves(side, shape, place, middle, unit(right - left), radius, grid.scale(middle))


def knob_loops(borders: Borders, shapes: KnobShapes, c: KnobCurves) -> tuple[Outlines, Knobs]:
    """Close curves outside the cell that they enter; inside is the other cell's label.

    A cell that no curve enters gets a frame around it that says its label.

    Parameters
    ----------
    borders : Borders
    shapes : KnobShapes
    c : KnobCurves

    Returns
    -------
    outlines : Outlines
    knobs : Knobs, in the order of the curves, without the waves
    """
    curves = c.drawn(shapes.points[c.shape])
    n_curves, n = curves.shape[:2]
    cell = borders.cell[c.side]
    framed = np.flatnonzero(~np.isin(borders.rim_cell, cell))
    frames = [_frame(borders.loops[a:b]) for a, b in borders.rim_span[framed].tolist()]
    loops = [curves.reshape(-1, 2), *frames]
    size = np.concatenate([np.full(n_curves, n), [len(frame) for frame in frames]]).astype(np.int64)
    inside = np.concatenate([borders.cell[borders.opposite(c.side)], borders.rim_cell[framed]])
    outside = np.concatenate([cell, borders.rim_cell[framed]])

    points = np.concatenate(loops)
    segments = np.stack([np.arange(len(points)), next_in_loop(size)], 1)
    outlines = Outlines(points, segments, np.repeat(inside, size), np.repeat(outside, size))
    first = n * np.flatnonzero(shapes.kind[c.shape] != WAVE)[:, None]
    neck = first + np.array(shapes.neck)
    return outlines, Knobs(neck, first + np.array(shapes.head), neck.copy())


def _frame(rim: Floats) -> Floats:
    """Draw a box around a loop (k, 2), anticlockwise; cells are far enough apart for it."""
    (left, low), (right, high) = rim.min(0) - _AROUND, rim.max(0) + _AROUND
    return np.array([[left, low], [right, low], [right, high], [left, high]])
