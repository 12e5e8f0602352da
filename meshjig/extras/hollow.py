"""Hollow a body out, and let what is inside run off."""

from __future__ import annotations

import numpy as np

from meshjig.extras.depth import Depth
from meshjig.extras.inset import inset_surface
from meshjig.mesh.booleans import Body, arrays, body, sound
from meshjig.mesh.measure import unit
from meshjig.mesh.types import Floats

__all__ = ["hollowed"]

_COARSE = 2.0  # cells of the outer side; nobody sees the inner one
_SMALLEST = 10.0  # cubes of the wall: a hollow that is not worth its drain
_DRAIN = 1.0  # walls, radius of a drain
_LONGEST = 4.0  # walls, length of a drain
_SIDES = 24


def hollowed(
    core: Body, around: Depth, depth: float, wall: float, cell: float, up: Floats
) -> tuple[Body, int]:
    """Leave a wall of a body, and open each hollow at its lowest point.

    Parameters
    ----------
    core : Body
    around : Depth, of the surface around it
    depth : float, mm, of the body's own surface
    wall : float, mm
    cell : float, mm, edge of a cube of the grid
    up : (3,) float64, unit

    Returns
    -------
    Body
        In one part. What is too small, or has no way out through the wall below it, stays filled.
    drains : int
    """
    V, F = inset_surface(around, depth + wall, _COARSE * cell, wall)
    drains = 0
    for hollow in body(V, F).decompose() if len(F) else []:
        if hollow.volume() < _SMALLEST * wall**3:
            continue
        points = arrays(hollow)[0]
        lowest = points[(points @ up).argmin()]
        opened = core - hollow - _drain(lowest + _DRAIN * wall * up, up, (_LONGEST + _DRAIN) * wall, wall)
        if sound(opened) and len(opened.decompose()) == 1:
            core, drains = opened, drains + 1
    return core, drains


def _drain(top: Floats, up: Floats, length: float, wall: float) -> Body:
    """Give a cylinder that goes down from a point."""
    import manifold3d

    side = unit(np.cross(up, np.eye(3)[np.abs(up).argmin()]))
    axes = np.stack([side, np.cross(up, side), up])
    rod = manifold3d.Manifold.cylinder(length, _DRAIN * wall, circular_segments=_SIDES)
    return rod.warp_batch(lambda p: (p - [0.0, 0.0, length]) @ axes + top)
