"""The classic knob: smooth and round, as sold in shops."""

import numpy as np

from meshjig.mesh.types import Floats
from meshjig.tiling.template import Template

__all__ = ["classic"]

_CUBICS = np.array(
    [
        [(0.0, 0.0), (0.20, 0.00), (0.42, -0.05), (0.435, 0.02)],
        [(0.435, 0.02), (0.445, 0.065), (0.375, 0.085), (0.375, 0.175)],
        [(0.375, 0.175), (0.375, 0.305), (0.625, 0.305), (0.625, 0.175)],
        [(0.625, 0.175), (0.625, 0.085), (0.555, 0.065), (0.565, 0.02)],
        [(0.565, 0.02), (0.58, -0.05), (0.80, 0.00), (1.0, 0.0)],
    ]
)


def classic(n: int) -> Template:
    """Draw one edge of a tile from (0, 0) to (1, 0) with a round knob to its left.

    Parameters
    ----------
    n : int, points a cubic; the edge has 5 n segments

    Returns
    -------
    Template
        Neck 0.13, head 0.25, height 0.27 of the edge.
    """
    points = np.vstack([_bezier(cubic, n) for cubic in _CUBICS] + [[(1.0, 0.0)]])
    return Template(points)


def _bezier(cubic: Floats, n: int) -> Floats:
    t = np.linspace(0, 1, n, endpoint=False)[:, None]
    a, b, c, d = cubic
    return (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
