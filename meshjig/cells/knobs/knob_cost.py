"""How good a knob would be by itself, and which knobs would come too near each other."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.knobs.knob_borders import places_along
from meshjig.cells.knobs.knob_curves import KnobCurves
from meshjig.cells.knobs.knob_places import LARGEST, Candidates, KnobSpec, Obstacles
from meshjig.cells.knobs.knob_shapes import SLIM, STOUT, WAVE, KnobShapes
from meshjig.cells.knobs.surface_grid import SurfaceGrid
from meshjig.mesh.arrays import equal_pairs
from meshjig.mesh.measure import unit
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["PLAIN", "bend", "conflicts", "costs", "tilt_cost"]

PLAIN = 8.0  # a border with neither knob nor wave
_KIND = {SLIM: 0.0, STOUT: 0.6, WAVE: 4.0}
_SMALL = {SLIM: 1.6, STOUT: 1.6, WAVE: 0.5}  # how much it matters that a curve is small
_BEND = [25, 35, 45, 55, 90], [0, 0.15, 0.8, 1.8, 3.0]  # degrees, and their cost
_CREASE_AWARE = 2.0  # times that cost
# degrees that walls lean by where a piece has to go in, and their cost: beyond 48 rather no knob
_TILT = [0, 20, 30, 40, 48, 60, 90], [0, 0.1, 0.5, 1.8, 8.0, 30.0, 90.0]
_OFF = 0.25
_CHANCE = 0.5  # at full randomness
_RIM = 20  # places on a curve at which normals are looked up
_ROOT = 0.62  # radius of the disc behind a neck, in half widths of the head


def costs(
    found: Candidates,
    grid: SurfaceGrid,
    shapes: KnobShapes,
    spec: KnobSpec,
    crease_aware: bool,
    rng: np.random.Generator,
) -> Floats:
    """Rate candidates, (c,); 0 is as good as can be."""
    c = found.curves
    kind = shapes.kind[c.shape]
    small = np.maximum(1 - c.radius * c.scale / (LARGEST * spec.s * spec.size), 0)
    bent = np.interp(bend(c, grid, shapes), *_BEND) * (_CREASE_AWARE if crease_aware else 1.0)
    by_kind = [np.array([table[k] for k in (SLIM, STOUT, WAVE)])[kind] for table in (_KIND, _SMALL)]
    chance = spec.random * _CHANCE * rng.random(len(small))
    return by_kind[0] + by_kind[1] * small * (1 + small) + _OFF * found.off**2 + bent + chance


def bend(c: KnobCurves, grid: SurfaceGrid, shapes: KnobShapes) -> Floats:
    """Give how far the surface's normals inside curves are off their mean at most, degrees; (c,)."""
    normals = _normals_inside(c, grid, shapes)
    cosine = np.einsum("ckd,cd->ck", normals, unit(normals.sum(1)))
    return np.degrees(np.arccos(np.clip(cosine.min(1), -1, 1)))


def tilt_cost(c: KnobCurves, grid: SurfaceGrid, shapes: KnobShapes, way: Floats) -> Floats:
    """Rate how far normals inside curves are off the ways out (c, 3) that their walls follow, (c,)."""
    cosine = np.einsum("ckd,cd->ck", _normals_inside(c, grid, shapes), way)
    return np.interp(np.degrees(np.arccos(np.clip(cosine.min(1), -1, 1))), *_TILT)


def _normals_inside(c: KnobCurves, grid: SurfaceGrid, shapes: KnobShapes) -> Floats:
    """Give the surface's normals at places in and on curves, (c, k, 3)."""
    last = shapes.points.shape[1] - 1
    at = np.linspace(shapes.foot, last - shapes.foot, _RIM).astype(int)
    samples = np.concatenate([shapes.discs[..., :2], shapes.points[:, at]], 1)[c.shape]
    return grid.normals(c.drawn(samples))


class _Discs(NamedTuple):
    """Sets of discs, each in the plane of a cell."""

    cell: Ints  # (c,)
    discs: Floats  # (c, d, 3), x, y, radius

    def bounds(self) -> Floats:
        """Give a disc around each set, (c, 3)."""
        middle = self.discs[..., :2].mean(1)
        away = self.discs[..., :2] - middle[:, None]
        reach = (np.hypot(away[..., 0], away[..., 1]) + self.discs[..., 2]).max(1)
        return np.concatenate([middle, reach[:, None]], 1)


def conflicts(obstacles: Obstacles, c: KnobCurves) -> Ints:
    """List pairs of curves on different borders that are too near each other, (k, 2).

    Two knobs in one cell keep their distance. A knob in a cell also keeps it from the root of one
    that leaves the cell: that would hang on a thread.
    """
    b = obstacles.borders
    shape = obstacles.shapes.discs[c.shape]
    inside = np.concatenate([c.drawn(shape[..., :2]), shape[..., 2:] * c.radius[:, None, None]], -1)
    knobs = _Discs(b.cell[c.side], inside)
    roots = _Discs(b.cell[b.opposite(c.side)], _roots(obstacles, c))
    border = b.border[c.side]
    pairs = []
    for other in (knobs, roots):
        i, j = equal_pairs(knobs.cell, other.cell)
        apart = (border[i] < border[j]) if other is knobs else (border[i] != border[j])
        i, j = i[apart], j[apart]
        close = _near(knobs.bounds(), other.bounds(), i, j, obstacles.clear)
        i, j = i[close], j[close]
        near = np.zeros(len(i), bool)
        for p in range(knobs.discs.shape[1]):
            for q in range(other.discs.shape[1]):
                near |= _near(knobs.discs[:, p], other.discs[:, q], i, j, obstacles.clear)
        pairs.append(np.sort(np.stack([i[near], j[near]], 1), axis=1))
    return np.unique(np.concatenate(pairs), axis=0)


def _roots(obstacles: Obstacles, c: KnobCurves) -> Floats:
    """Give discs where curves leave the cell that they belong to, (c, 1, 3)."""
    b = obstacles.borders
    mm, start, other = b.mm(), b.along[b.span[:, 0]], b.opposite(c.side)
    at = (c.place - start[c.side]) / mm[c.side]
    middle = places_along(b, start[other] + (1 - at) * mm[other])
    return np.concatenate([middle, _ROOT * c.radius[:, None]], 1)[:, None]


def _near(a: Floats, b: Floats, i: Ints, j: Ints, gap: float) -> Bools:
    """Tell which pairs of discs a[i] and b[j] are less than a gap apart."""
    d = a[i] - b[j]
    return d[:, 0] ** 2 + d[:, 1] ** 2 < (a[i, 2] + b[j, 2] + gap) ** 2
