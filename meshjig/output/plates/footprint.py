"""What a piece covers of the plate that it lies on."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.types import Floats, Ints

__all__ = ["convex_ring", "footprint", "least_rectangle", "size_at"]

_SMOOTH = 0.05  # mm; outlines are drawn and packed no finer
_SPECK = 0.01  # mm2; smaller holes are left out


def footprint(V: Floats, F: Ints) -> Any:
    """Give the shadow of a piece on the xy plane.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, closed and oriented outward

    Returns
    -------
    shapely.Polygon, mm
        Within 0.05 mm of the shadow; the shadow of the convex hull where the piece is no proper solid.
    """
    import manifold3d
    import shapely

    mesh = manifold3d.Mesh64(np.ascontiguousarray(V), F.astype(np.uint64))
    loops = manifold3d.Manifold(mesh).project().to_polygons()
    outlines = [shapely.Polygon(loop) for loop in loops if len(loop) > 2]
    if not outlines:
        return shapely.MultiPoint(V[:, :2]).convex_hull
    largest = max(outlines, key=lambda outline: outline.area)
    holes = [hole.exterior for hole in outlines if not hole.exterior.is_ccw and hole.area > _SPECK]
    return shapely.Polygon(largest.exterior, holes).simplify(_SMOOTH)


def convex_ring(points: Floats) -> Floats:
    """Give the corners of the convex hull of points (n, 2), counterclockwise; (k, 2)."""
    from scipy.spatial import ConvexHull

    return points[ConvexHull(points).vertices]


def least_rectangle(ring: Floats) -> float:
    """Find the turn at which a convex ring needs the least rectangle along the axes.

    Parameters
    ----------
    ring : (k, 2) float64, convex, counterclockwise

    Returns
    -------
    float
        Radians, counterclockwise, in [0, pi); the rectangle is no deeper than wide.

    References
    ----------
    Freeman and Shapira, "Determining the minimum-area encasing rectangle for an arbitrary closed curve",
    1975: one side of it lies along a side of the ring.
    """
    side = np.roll(ring, -1, axis=0) - ring
    turns = -np.arctan2(side[:, 1], side[:, 0])
    sizes = size_at(ring, turns)
    best = int(sizes.prod(axis=1).argmin())
    turn = turns[best] + (np.pi / 2 if sizes[best, 1] > sizes[best, 0] else 0.0)
    return float(turn % np.pi)


def size_at(points: Floats, turns: Floats) -> Floats:
    """Give the width and depth of points (n, 2) at turns (k,), radians; (k, 2)."""
    cos, sin = np.cos(turns), np.sin(turns)
    x = points @ np.stack([cos, -sin])
    y = points @ np.stack([sin, cos])
    return np.stack([np.ptp(x, axis=0), np.ptp(y, axis=0)], 1)
