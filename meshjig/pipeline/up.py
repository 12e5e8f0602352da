"""Which way is up: what was asked, else what the file says, else what the shape suggests."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.output.pictures.view import axis_of, guess_up
from meshjig.scan import Scan
from meshjig.scan.source import Source

__all__ = ["AUTO", "up_axis", "up_direction"]

AUTO = "auto"


def up_axis(up: str, source: Source) -> int:
    """Give the axis of a model along which a floor is cut off.

    Parameters
    ----------
    up : str
        x, y or z; or ``auto``: what the file says, else z; a guess by the shape is for pictures only.
    source : Source

    Returns
    -------
    int, 0, 1 or 2
    """
    said = source.up if up == AUTO else up
    return int(np.abs(axis_of(said)).argmax()) if said else 2


def up_direction(up: str, scan: Scan) -> Floats:
    """Give the direction in which a model is up, as pictures show it.

    Parameters
    ----------
    up : str
        x, y or z; or ``auto``: the axis along which a floor was cut off, else what the file says, else as
        `guess_up` has it, perhaps between the axes.
    scan : Scan

    Returns
    -------
    (3,) float64, a unit vector
    """
    floor = scan.facts.floor
    said = (floor.axis if floor else scan.source.up) if up == AUTO else up
    return (axis_of(said) if said else guess_up(*scan.mesh)) + 0.0  # no -0 in the report
