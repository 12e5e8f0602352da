"""Squares: one tile, moved along and across."""

from collections.abc import Callable

import numpy as np

from meshjig.tiling.template import Template
from meshjig.tiling.unit import Unit

__all__ = ["squares"]


def squares(template: Callable[[int], Template]) -> Unit:
    """Repeat a square whose edges carry a knob on either side.

    Parameters
    ----------
    template : callable, the knob, drawn with n points a part

    Returns
    -------
    Unit
    """
    return Unit(
        translations=np.eye(2),
        corners=np.zeros((1, 2)),
        ends=np.array([[(0, 0, 0), (0, 1, 0)], [(0, 0, 0), (0, 0, 1)]]),
        sides=np.array([[(0, 0, 0), (0, 0, -1)], [(0, -1, 0), (0, 0, 0)]]),
        n_tiles=1,
        template=template,
        knob_side=np.zeros(2, np.int64),
    )
