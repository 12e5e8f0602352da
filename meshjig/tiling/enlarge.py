"""A knob made larger or smaller, or moved along its edge."""

import numpy as np

from meshjig.mesh.types import Floats
from meshjig.tiling.template import Template

__all__ = ["enlarged", "moved_knob"]

_REACH = 0.2  # half of the part of an edge that is moved as a whole


def enlarged(template: Template, factor: float) -> Template:
    """Scale the knob of an edge about the edge's middle; what lies beside it gives way.

    Parameters
    ----------
    template : Template
    factor : float, below 2.5

    Returns
    -------
    Template
    """
    return Template(moved_knob(template.points, factor, 0.5))


def moved_knob(points: Floats, factor: float, middle: float) -> Floats:
    """Scale the middle part of an edge and move it along; what lies beside it gives way.

    Parameters
    ----------
    points : (n, 2) float64, from (0, 0) to (1, 0)
    factor : float
    middle : float, where the middle of the edge goes; at least factor / 5 from both ends

    Returns
    -------
    (n, 2) float64
    """
    low, high = 0.5 - _REACH, 0.5 + _REACH
    new_low, new_high = middle - _REACH * factor, middle + _REACH * factor
    x = np.interp(points[:, 0], [0.0, low, high, 1.0], [0.0, new_low, new_high, 1.0])
    return np.stack([x, points[:, 1] * factor], 1)
