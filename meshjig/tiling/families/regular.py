"""Regular tilings with knobs on straight edges: squares, four of them turned about a corner, and hexagons."""

from collections.abc import Callable

import numpy as np

from meshjig.tiling.template import Template, classic, enlarged, leaning
from meshjig.tiling.unit import Unit

__all__ = ["hexagons", "macro", "squares"]

_EDGE = float(np.sqrt(2 / np.sqrt(27)))  # of a hexagon of area 1
_LARGER = 1.4  # the edge is shorter than that of a square, its knob need not be


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


def hexagons() -> Unit:
    """Repeat a regular hexagon that stands on a corner.

    Returns
    -------
    Unit
    """
    wide = np.sqrt(3) * _EDGE
    return Unit(
        translations=np.array([(wide, 0.0), (wide / 2, 1.5 * _EDGE)]),
        corners=_EDGE * np.array([(0.0, -1.0), (0.0, 1.0)]),
        ends=np.array([[(1, 1, -1), (0, 0, 1)], [(0, 0, 1), (1, 0, 0)], [(1, 0, 0), (0, -1, 1)]]),
        sides=np.array([[(0, 0, 0), (0, 1, 0)], [(0, 0, 0), (0, 0, 1)], [(0, 0, 0), (0, -1, 1)]]),
        n_tiles=1,
        template=_knob,
        knob_side=np.zeros(3, np.int64),
    )


def _knob(n: int) -> Template:
    return enlarged(classic(n), _LARGER)
