"""The bodies that take the gap out of the pieces, made of the walls between them."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.booleans import Body, body, sound
from meshjig.mesh.measure import unit
from meshjig.mesh.types import Floats, Ints
from meshjig.solid.offsets import Offsets, Strip, mitered
from meshjig.solid.slab import slabs

__all__ = ["ball", "cutters", "round_cutters"]

_RING = np.pi / 4 * np.arange(8) + np.pi / 8  # corners of an octagon with a side towards 0


def cutters(strip: Strip, offsets: Offsets, half: float) -> list[tuple[Ints, Body]]:
    """Thicken walls to bodies as wide as the gap: long slabs, and hulls of what can't be made one.

    Parameters
    ----------
    strip : Strip
    offsets : Offsets
    half : float, mm

    Returns
    -------
    list of (quads (k,) int64, body); every quad is in one of them
    """
    made: list[tuple[Ints, Any]] = []
    left = np.flatnonzero(offsets.failed).tolist()
    for quads, V, F in slabs(strip, offsets, half):
        slab = body(V, F)
        if sound(slab):
            made.append((quads, slab))
        else:
            left += quads.tolist()
    return made + [(np.array([s]), _hull(strip.corners[s], half)) for s in left]


def round_cutters(strip: Strip, quads: Ints, half: float) -> list[Body]:
    """Thicken quads one by one, for a slab that turned out to cross itself."""
    if len(quads) == 1:
        return [_hull(strip.corners[quads[0]], half)]
    alone = Strip(strip.corners[quads], strip.rising[quads], np.full(len(quads), -1))
    return [cutter for _, cutter in cutters(alone, mitered(alone, half), half)]


def _hull(corners: Floats, half: float) -> Body:
    """Give the convex hull of two prisms, along the ends of a quad and wide enough for its gap."""
    import manifold3d

    first, last = corners[0] - corners[1], corners[2] - corners[3]
    across = np.cross(corners[2] - corners[0] + corners[3] - corners[1], first + last)
    points = []
    for top, bottom in corners.reshape(2, 2, 3):
        axis = unit(top - bottom)
        side = unit(across - (across @ axis) * axis)
        if not side.any():
            side = unit(np.cross(axis, np.eye(3)[np.abs(axis).argmin()]))
        ring = np.cos(_RING)[:, None] * side + np.sin(_RING)[:, None] * np.cross(axis, side)
        points += [top + half / np.cos(np.pi / 8) * ring, bottom + half / np.cos(np.pi / 8) * ring]
    return manifold3d.Manifold.hull_points(np.concatenate(points))


def ball() -> Floats:
    """Give the corners of an icosahedron around the unit ball, (12, 3)."""
    g = (1 + np.sqrt(5)) / 2
    points = np.array([[0, a, b * g] for a in (-1, 1) for b in (-1, 1)], float)
    points = np.concatenate([points, np.roll(points, 1, 1), np.roll(points, 2, 1)])
    return points * np.sqrt(3) / g**2
