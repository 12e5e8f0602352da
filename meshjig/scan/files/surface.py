"""Polygons as a file lists them, as triangles; what can't be one is counted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Bools, Floats, Ints, ragged, starts
from meshjig.mesh.polygons import triangulate_polygons

__all__ = ["Surface", "levels", "surface"]


@dataclass(frozen=True)
class Surface:
    """Triangles, and what of the file each is made of."""

    F: Ints  # (m, 3)
    corner: Ints  # (m, 3), places in the file's list of corners
    polygon: Ints  # (m,), places in the file's list of polygons
    found: int  # how many of the file's polygons these are made of


def surface(V: Floats, corners: Ints, sizes: Ints) -> Surface:
    """Make triangles of polygons, those left out that have fewer than three corners, or any that is none.

    Parameters
    ----------
    V : (n, 3) float64
    corners : (c,) int64, polygon after polygon; those out of range name no vertex
    sizes : (p,) int64, not negative

    Returns
    -------
    Surface
    """
    good = (corners >= 0) & (corners < len(V))
    finite = np.asarray(np.isfinite(V).all(axis=1))
    if not finite.all():
        good[good] = finite[corners[good]]
    if good.all() and (sizes >= 3).all():
        made = triangulate_polygons(V, corners, sizes)
        return Surface(corners[made.corner], made.corner, made.polygon, len(sizes))
    kept = np.flatnonzero((sizes >= 3) & _all_of(good, sizes))
    at = ragged(starts(sizes)[kept], sizes[kept])
    made = triangulate_polygons(V, corners[at], sizes[kept])
    corner = at[made.corner]
    return Surface(corners[corner], corner, kept[made.polygon], len(kept))


def levels(colours: Floats, whole: bool = False) -> NDArray[np.uint8]:
    """Give colours as bytes, white for NaN.

    Parameters
    ----------
    colours : (..., 3) float64
    whole : bool, whether they are known to be 0 to 255; else they are 0 to 1 where none is larger
    """
    most = colours.max(initial=0.0, where=np.isfinite(colours))
    scale = 1.0 if whole or most > 1.0 else 255.0
    known = np.nan_to_num(colours * scale, nan=255.0, posinf=255.0, neginf=0.0)
    return np.rint(np.clip(known, 0, 255)).astype(np.uint8)


def _all_of(good: Bools, sizes: Ints) -> Bools:
    """Whether each of several lists holds nothing but what is good, (p,)."""
    bad = np.concatenate([[0], np.cumsum(~good)])
    first = starts(sizes)
    return bad[first + sizes] == bad[first]
