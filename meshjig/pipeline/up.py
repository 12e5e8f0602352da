"""Which way is up: what was asked, else what the file says, else what the shape suggests."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.mesh.mesh import Mesh
from meshjig.output.pictures.view import axis_of, guess_up
from meshjig.scan.source import Source

__all__ = ["up_axis", "up_direction"]

AUTO = "auto"


def up_axis(up: str, source: Source) -> int:
    """Give the axis of a model that points upward.

    Parameters
    ----------
    up : str
        x, y or z; or ``auto``: what the file says, else the axis nearest to `guess_up`.
    source : Source

    Returns
    -------
    int, 0, 1 or 2
    """
    return int(np.abs(up_direction(up, source, Mesh(source.vertices, source.faces))).argmax())


def up_direction(up: str, source: Source, surface: Mesh) -> Floats:
    """Give the direction in which a model is up, as pictures show it.

    Parameters
    ----------
    up : str
        As for `up_axis`; but a guess may lie between the axes, where the model's base is tilted.
    source : Source
    surface : Mesh, of the model; turned as the source is

    Returns
    -------
    (3,) float64, a unit vector
    """
    said = source.up if up == AUTO else up
    return (axis_of(said) if said else guess_up(surface.V, surface.F)) + 0.0  # no -0 in the report
