"""The body that cuts an outline into a flat sheet: a groove with sloping sides."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body, body

__all__ = ["TOP", "groove"]

TOP = 0.5  # of its depth, that the body reaches out of the sheet
_SMOOTH = 0.1  # insets, by which outlines may be simplified
_QUARTER = 3  # segments a quarter of a round corner


def groove(outline: Any, inset: float) -> Body:
    """Give the body of a groove that is 1 deep and narrows by an inset on either side.

    Parameters
    ----------
    outline : shapely.Polygon or MultiPolygon, mm, at z = 0
    inset : float, mm, at z = -1; more than 0, less than half of the narrowest stroke

    Returns
    -------
    Body
        From z = -1 to 0.5.

    Notes
    -----
    Its sides are a height over the plane, so they can't cross each other.
    """
    floor, rim = (
        _rings(outline.buffer(step * inset, quad_segs=_QUARTER).simplify(_SMOOTH * inset))
        for step in (-1.0, TOP)
    )
    n = sum(len(ring) for ring in floor)
    points = np.concatenate(floor + rim)
    slopes = _triangles([ring[::-1] for ring in floor] + rim)
    turned = np.concatenate([start + np.arange(len(ring))[::-1] for start, ring in _starts(floor)])
    slopes = np.where(slopes < n, turned[np.minimum(slopes, n - 1)], slopes)
    below = np.concatenate([_triangles(floor), slopes])[:, ::-1]
    height = np.where(np.arange(len(points)) < n, -1.0, TOP)
    return body(np.column_stack([points, height]), np.concatenate([below, _triangles(rim) + n]))


def _rings(shape: Any) -> list[Floats]:
    """List the rings of polygons, each with the inside on its left."""
    import shapely

    parts = shapely.get_parts(shapely.orient_polygons(shape))
    rings = [ring for part in parts for ring in (part.exterior, *part.interiors)]
    return [np.array(ring.coords)[:-1] for ring in rings]


def _starts(rings: list[Floats]) -> list[tuple[int, Floats]]:
    ends = np.cumsum([len(ring) for ring in rings]).tolist()
    return [(end - len(ring), ring) for end, ring in zip(ends, rings, strict=True)]


def _triangles(rings: list[Floats]) -> Ints:
    """Cut polygons with holes into triangles that turn to the left."""
    import manifold3d

    return np.asarray(manifold3d.triangulate(rings), np.int64)
