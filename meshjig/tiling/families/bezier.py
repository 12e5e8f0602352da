"""Chains of cubic Bezier curves as polylines."""

import numpy as np

from meshjig.mesh.types import Floats

__all__ = ["bezier_chain"]


def bezier_chain(cubics: Floats, n: int) -> Floats:
    """Draw cubics that follow each other.

    Parameters
    ----------
    cubics : (k, 4, 2) float64, each begins where the one before it ends
    n : int, segments a cubic

    Returns
    -------
    (k n + 1, 2) float64
    """
    t = np.linspace(0, 1, n, endpoint=False)[:, None]
    a, b, c, d = cubics.transpose(1, 0, 2)[:, :, None]
    drawn = (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
    return np.vstack([*drawn, cubics[-1, -1:]])
