"""Knobs as cuts through the plane: closed loops with labels."""

import numpy as np

from meshjig.cells.knobs.knob_borders import Borders
from meshjig.cells.knobs.knob_obstacles import Curves
from meshjig.cells.knobs.knob_shapes import WAVE, Shapes
from meshjig.mesh.types import Floats, Knobs, Outlines

__all__ = ["knob_loops"]

_AROUND = 0.3  # mm from a cell to the frame around it


def knob_loops(borders: Borders, shapes: Shapes, c: Curves) -> tuple[Outlines, Knobs]:
    """Close curves outside the cell that they enter; inside is the other cell's label.

    A cell that no curve enters gets a frame around it that says its label.

    Parameters
    ----------
    borders : Borders
    shapes : Shapes
    c : Curves

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
    tail = np.arange(len(points))
    head = tail + 1
    head[np.cumsum(size) - 1] = np.cumsum(size) - size
    outlines = Outlines(points, np.stack([tail, head], 1), np.repeat(inside, size), np.repeat(outside, size))
    first = n * np.flatnonzero(shapes.kind[c.shape] != WAVE)[:, None]
    neck = first + np.array(shapes.neck)
    return outlines, Knobs(neck, first + np.array(shapes.head), neck.copy())


def _frame(rim: Floats) -> Floats:
    """Draw a box around a loop (k, 2), anticlockwise; cells are far enough apart for it."""
    (left, low), (right, high) = rim.min(0) - _AROUND, rim.max(0) + _AROUND
    return np.array([[left, low], [right, low], [right, high], [left, high]])
