"""Colours as screens have them, and as light adds up."""

import numpy as np

from meshjig.mesh.types import Floats

__all__ = ["to_linear", "to_srgb"]


def to_linear(srgb: Floats) -> Floats:
    """Take sRGB values, 0 to 1, to linear light."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def to_srgb(linear: Floats) -> Floats:
    """Take linear light to sRGB values, 0 to 1; what a screen can't show is clipped."""
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
