"""Stretch as a colour: pale where a map keeps lengths, red where it does not."""

import numpy as np

from meshjig.mesh.measure import singular_values
from meshjig.mesh.types import Atlas, Floats

__all__ = ["MOST", "heat", "stretch"]

MOST = 1.5  # the darkest colour; tiles this much longer, or shorter, look wrong at a glance

_STOPS = np.array([1.0, 1.1, 1.25, MOST])
_COLOURS = np.array([(0.93, 0.95, 0.97), (0.98, 0.87, 0.55), (0.91, 0.45, 0.20), (0.55, 0.05, 0.15)])


def stretch(atlas: Atlas) -> Floats:
    """Give how much longer or shorter a length may become in each face, (m,) float64, at least 1."""
    s = singular_values(atlas.mesh.V, atlas.mesh.F, atlas.uv, atlas.F_uv)
    return np.maximum(np.maximum(s[:, 0], 1 / np.maximum(s[:, 1], 1e-9)), 1.0)


def heat(value: Floats) -> Floats:
    """Give the colours (m, 3), sRGB, 0 to 1, of stretches (m,)."""
    return np.stack([np.interp(value, _STOPS, _COLOURS[:, k]) for k in range(3)], 1)
