"""Units of few tiles, for tests of what is laid and drawn."""

import numpy as np

from meshjig.tiling import Unit, squares
from meshjig.tiling.template import classic, rectangular


def waves():
    """Squares that interlock by their shape: every edge is a wave that overhangs."""
    t = np.linspace(0, 1, 33)
    along = t - 0.12 * np.sin(4 * np.pi * t) * np.sin(np.pi * t)
    across = 0.2 * np.sin(2 * np.pi * t)
    base = squares(classic)
    curves = (np.stack([along, across], 1), np.stack([-across, along], 1))
    return Unit(base.translations, base.corners, base.ends, base.sides, 1, curves=curves)


def bricks():
    """Two bricks a unit, one row half a brick off the other: corners lie inside edges, six to a brick."""
    w, h = np.sqrt(2), np.sqrt(0.5)
    return Unit(
        translations=np.array([(w, 0.0), (0.0, 2 * h)]),
        corners=np.array([(0.0, 0.0), (w / 2, 0.0), (w / 2, h), (w, h)]),
        ends=np.array(
            [
                [(0, 0, 0), (1, 0, 0)],
                [(1, 0, 0), (0, 1, 0)],
                [(2, 0, 0), (3, 0, 0)],
                [(3, -1, 0), (2, 0, 0)],
                [(0, 0, 0), (3, -1, 0)],
                [(2, 0, 0), (1, 0, 1)],
            ]
        ),
        sides=np.array(
            [
                [(0, 0, 0), (1, -1, -1)],
                [(0, 0, 0), (1, 0, -1)],
                [(1, 0, 0), (0, 0, 0)],
                [(1, -1, 0), (0, 0, 0)],
                [(0, -1, 0), (0, 0, 0)],
                [(1, -1, 0), (1, 0, 0)],
            ]
        ),
        n_tiles=2,
        template=rectangular,
    )
