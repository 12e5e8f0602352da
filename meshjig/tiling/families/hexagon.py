"""Regular hexagons, with a knob on each of their straight edges."""

import numpy as np

from meshjig.tiling.classic import classic
from meshjig.tiling.enlarge import enlarged
from meshjig.tiling.template import Template
from meshjig.tiling.unit import Unit

__all__ = ["hexagons"]

_EDGE = float(np.sqrt(2 / np.sqrt(27)))  # of a hexagon of area 1
_LARGER = 1.4  # the edge is shorter than that of a square, its knob need not be


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
