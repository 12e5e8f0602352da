"""How good a knob would be: large, in the middle of its border, and not wrapped around a crease."""

import numpy as np

from meshjig.cells.knobs.knob_obstacles import Curves
from meshjig.cells.knobs.knob_places import LARGEST, Candidates, Wish
from meshjig.cells.knobs.knob_shapes import SLIM, STOUT, WAVE, Shapes
from meshjig.cells.knobs.surface_grid import Ground
from meshjig.mesh.measure import unit
from meshjig.mesh.types import Floats

__all__ = ["PLAIN", "bend", "costs"]

PLAIN = 8.0  # a border with neither knob nor wave
_KIND = {SLIM: 0.0, STOUT: 0.6, WAVE: 4.0}
_SMALL = {SLIM: 1.6, STOUT: 1.6, WAVE: 0.5}  # how much it matters that a curve is small
_BEND = [25, 35, 45, 55, 90], [0, 0.15, 0.8, 1.8, 3.0]  # degrees, and their cost
_CREASE_AWARE = 2.0  # times that cost
_OFF = 0.25
_CHANCE = 0.5  # at full randomness
_RIM = 20  # places on a curve at which normals are looked up


def costs(
    found: Candidates,
    ground: Ground,
    shapes: Shapes,
    wish: Wish,
    crease_aware: bool,
    rng: np.random.Generator,
) -> Floats:
    """Rate candidates, (c,); 0 is as good as can be."""
    c = found.curves
    kind = shapes.kind[c.shape]
    small = np.maximum(1 - c.radius * c.scale / (LARGEST * wish.s * wish.size), 0)
    bent = np.interp(bend(c, ground, shapes), *_BEND) * (_CREASE_AWARE if crease_aware else 1.0)
    by_kind = [np.array([table[k] for k in (SLIM, STOUT, WAVE)])[kind] for table in (_KIND, _SMALL)]
    chance = wish.random * _CHANCE * rng.random(len(small))
    return by_kind[0] + by_kind[1] * small * (1 + small) + _OFF * found.off**2 + bent + chance


def bend(c: Curves, ground: Ground, shapes: Shapes) -> Floats:
    """Give how far the surface's normals inside curves are off their mean at most, degrees; (c,)."""
    last = shapes.points.shape[1] - 1
    at = np.linspace(shapes.foot, last - shapes.foot, _RIM).astype(int)
    samples = np.concatenate([shapes.discs[..., :2], shapes.points[:, at]], 1)[c.shape]
    normals = ground.normals(c.drawn(samples))
    cosine = np.einsum("ckd,cd->ck", normals, unit(normals.sum(1)))
    return np.degrees(np.arccos(np.clip(cosine.min(1), -1, 1)))
