"""The wall of a whole model in which thin parts have no hollow, and walls that lead through them."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats
from meshjig.mesh.booleans import Body, body, sound
from meshjig.mesh.mesh import Mesh
from meshjig.solid.solidify import solidify

__all__ = ["between_sides", "past_far_side", "wall_of_model"]

_BEYOND = 1.0  # mm, that walls go past the far side, or as much of that as there is room for
_ROOM = 0.45  # of the free way to whatever comes next
_PLUG = 0.75  # of the way through, that plugs reach: into the wall of the far side


def past_far_side(D: Floats, direction: Floats, length: Floats, free: Floats) -> Floats:
    """Lead walls along the way through, past the far side.

    Parameters
    ----------
    D : (n, 3) float64, mm, to the inner sheet
    direction : (n, 3) float64, unit, the way through, outward
    length, free : (n,) float64, mm, to the far side, 0 where there is no way; from there to what comes next

    Returns
    -------
    (n, 3) float64, mm; D where there is no way through
    """
    through = -(length + np.minimum(_ROOM * free, _BEYOND))[:, None] * direction
    return np.where(length[:, None] > 0, through, D)


def between_sides(surface: Mesh, owned: Bools, ways: Floats) -> Mesh:
    """Give all that lies below some faces, down to the far side of thin parts.

    Parameters
    ----------
    surface : Mesh, the outer sheet
    owned : (m,) bool, faces below which there is a way through, at least one
    ways : (n, 3) float64, mm, from their vertices to the far side
    """
    V, F, _ = solidify(surface.V, surface.F, np.where(owned, 0, -1), ways)[0][0]
    return Mesh(V, F)


def wall_of_model(surface: Mesh, D: Floats, plugged: Bools, ways: Floats) -> Body:
    """Give the wall of a whole model as one body: its shell, and thin parts filled up.

    Parameters
    ----------
    surface : Mesh, the outer sheet
    D : (n, 3) float64, mm, to the inner sheet
    plugged : (m,) bool, faces under which no hollow is left
    ways : (n, 3) float64, mm, from plugged faces to the far side
    """
    V, F = surface
    whole = solidify(V, F, np.zeros(len(F), np.int64), D)[0][0]
    wall = body(whole.V, whole.F)
    if not plugged.any():
        return wall
    plug = solidify(V, F, np.where(plugged, 0, -1), _PLUG * ways)[0][0]
    filled = body(plug.V, plug.F)
    return wall + filled if sound(filled) else wall
