"""How evenly and how completely pieces divide a surface."""

import numpy as np

from meshjig.mesh.arrays import Floats

__all__ = ["area_cv", "area_error"]


def area_cv(area: Floats) -> float | None:
    """Give the coefficient of variation of the pieces' areas: standard deviation over mean.

    Parameters
    ----------
    area : (n,) float64, mm2, of each piece

    Returns
    -------
    float, 0 when all are equal; None for no pieces
    """
    mean = float(np.mean(area)) if len(area) else 0.0
    return float(np.std(area)) / mean if mean > 0 else None


def area_error(parts: Floats, surface: Floats) -> float | None:
    """Say how far the area of all parts, gap included, is from the area of the surface.

    Parameters
    ----------
    parts : (n,) float64, mm2, areas that together should cover the surface once
    surface : (m,) float64, mm2, face areas of the uncut surface

    Returns
    -------
    float, relative to the surface; None for a surface without area
    """
    whole = float(np.sum(surface))
    return abs(float(np.sum(parts)) - whole) / whole if whole > 0 else None
