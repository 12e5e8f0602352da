"""Four tiles, each a quarter turn from the last, make the square that is moved."""

import numpy as np

from meshjig.tiling.families.bezier import bezier_chain
from meshjig.tiling.template import Template
from meshjig.tiling.unit import Unit

__all__ = ["leaning", "macro"]

_CUBICS = np.array(
    [
        [(0.0, 0.0), (0.18, 0.00), (0.345, -0.06), (0.395, -0.01)],
        [(0.395, -0.01), (0.43, 0.035), (0.375, 0.085), (0.405, 0.17)],
        [(0.405, 0.17), (0.45, 0.335), (0.75, 0.28), (0.69, 0.12)],
        [(0.69, 0.12), (0.66, 0.055), (0.54, 0.075), (0.54, 0.015)],
        [(0.54, 0.015), (0.54, -0.05), (0.79, 0.00), (1.0, 0.0)],
    ]
)


def leaning(n: int) -> Template:
    """Draw one edge of a tile from (0, 0) to (1, 0) with a knob that leans forward, to its left.

    Parameters
    ----------
    n : int, points a cubic; the edge has 5 n segments

    Returns
    -------
    Template
    """
    return Template(bezier_chain(_CUBICS, n))


def macro() -> Unit:
    """Repeat two by two tiles, turned by 0, 90, 180 and 270 degrees about their common corner.

    All edges start at a corner about which the tiling turns: the one inside the four tiles and the one
    between four copies. So the four tiles are congruent, lean of the knobs included.

    Returns
    -------
    Unit
    """
    middle, outer, below, beside = range(4)
    first, second, third, fourth = range(4)  # counterclockwise, from the lower left
    return Unit(
        translations=2 * np.eye(2),
        corners=np.array([(1.0, 1.0), (0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]),
        ends=np.array(
            [
                [(middle, 0, 0), (below, 0, 0)],
                [(middle, 0, 0), (beside, 1, 0)],
                [(middle, 0, 0), (below, 0, 1)],
                [(middle, 0, 0), (beside, 0, 0)],
                [(outer, 0, 0), (below, 0, 0)],
                [(outer, 1, 0), (beside, 1, 0)],
                [(outer, 1, 1), (below, 0, 1)],
                [(outer, 0, 1), (beside, 0, 0)],
            ]
        ),
        sides=np.array(
            [
                [(second, 0, 0), (first, 0, 0)],
                [(third, 0, 0), (second, 0, 0)],
                [(fourth, 0, 0), (third, 0, 0)],
                [(first, 0, 0), (fourth, 0, 0)],
                [(first, 0, 0), (fourth, 0, -1)],
                [(second, 0, 0), (first, 1, 0)],
                [(third, 0, 0), (second, 0, 1)],
                [(fourth, 0, 0), (third, -1, 0)],
            ]
        ),
        n_tiles=4,
        template=leaning,
        knob_side=np.array([1, 1, 1, 1, -1, -1, -1, -1]),
    )
