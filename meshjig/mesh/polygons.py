"""Triangles of polygons in space, concave ones too."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints, next_in_loop, ragged, row_of, starts
from meshjig.mesh.ears import LARGE, clip_ears

__all__ = ["Triangles", "newell_normals", "triangulate_polygons"]

_AT_ONCE = 200_000  # quadrilaterals
_PATIENT = 500  # corners; up to so many, a polygon gets all the time that clipping takes


class Triangles(NamedTuple):
    """Triangles, and the polygons that they are parts of, in the order of these."""

    corner: Ints  # (t, 3), places in the list of all corners
    polygon: Ints  # (t,)


def triangulate_polygons(V: Floats, corners: Ints, sizes: Ints) -> Triangles:
    """Split polygons along diagonals that lie inside them, so that every corner stays a corner of triangles.

    Each polygon is looked at along its Newell normal. Quadrilaterals are split from their first corner to the
    third unless only the other diagonal lies inside. A polygon that crosses itself is split somehow.

    Parameters
    ----------
    V : (n, 3) float64
    corners : (c,) int64, into V, polygon after polygon
    sizes : (p,) int64, how many corners each polygon has; those with fewer than three have no triangles

    Returns
    -------
    Triangles
    """
    first = starts(sizes)
    if (sizes == 3).all():
        return Triangles(np.arange(3 * len(sizes)).reshape(-1, 3), np.arange(len(sizes)))
    three, four, more = (np.flatnonzero(found) for found in (sizes == 3, sizes == 4, sizes > 4))
    parts = [first[three][:, None] + np.arange(3)]
    owners = [three]
    for k in range(0, len(four), _AT_ONCE):
        some = four[k : k + _AT_ONCE]
        parts.append(first[some][:, None, None] + _halves(V[corners[first[some][:, None] + np.arange(4)]]))
        owners.append(np.repeat(some, 2))
    if len(more):
        at = ragged(first[more], sizes[more])
        triangles, owner = _clipped(V[corners[at]], sizes[more])
        parts.append(at[triangles])
        owners.append(more[owner])
    polygon = np.concatenate(owners)
    order = np.argsort(polygon, kind="stable")
    return Triangles(np.concatenate([part.reshape(-1, 3) for part in parts])[order], polygon[order])


def newell_normals(P: Floats, sizes: Ints) -> Floats:
    """Give the normal of each polygon, twice as long as its area, (p, 3).

    Parameters
    ----------
    P : (c, 3) float64, corners, polygon after polygon
    sizes : (p,) int64, all positive
    """
    first = starts(sizes)
    D = P - np.repeat(P[first], sizes, axis=0)
    return np.add.reduceat(np.cross(D, D[next_in_loop(sizes)]), first, axis=0)


def _halves(P: Floats) -> Ints:
    """The halves of quadrilaterals (q, 4, 3): (q, 2, 3), numbers of corners."""
    a, b, c, d = P.transpose(1, 0, 2)
    normal = np.cross(c - a, d - b)

    def inside(p: Floats, q: Floats, r: Floats) -> Floats:
        return np.einsum("ij,ij->i", np.cross(q - p, r - p), normal)

    first = np.minimum(inside(a, b, c), inside(a, c, d))
    other = np.minimum(inside(a, b, d), inside(b, c, d))
    turned = (first <= 0) & (other > 0)
    return np.where(turned[:, None, None], [[0, 1, 3], [1, 2, 3]], [[0, 1, 2], [2, 3, 0]])


def _clipped(P: Floats, sizes: Ints) -> tuple[Ints, Ints]:
    """Triangles (t, 3) into P (c, 3), and the polygon of each (t,)."""
    normal = newell_normals(P, sizes)
    axis = np.abs(normal).argmax(axis=1)
    back = normal[np.arange(len(sizes)), axis] < 0
    u, v = (
        (axis + 1 + back) % 3,
        (axis + 2 - back) % 3,
    )  # to look at it from its front, along an axis of space
    polygon = row_of(sizes)
    first = starts(sizes)
    D = P - np.repeat(P[first], sizes, axis=0)
    flat = np.take_along_axis(D, np.stack([u, v], 1)[polygon], axis=1)
    T, owner, failed = clip_ears(flat, first, sizes)
    parts, owners = [T], [owner]
    for k in failed:
        T = first[k] + _one(flat[first[k] : first[k] + sizes[k]])
        parts.append(T)
        owners.append(np.full(len(T), k))
    return np.concatenate(parts), np.concatenate(owners)


def _one(P: Floats) -> Ints:
    """Triangulate a polygon in the plane (k, 2) that clipping by groups has failed on: (t, 3)."""
    import mapbox_earcut

    k = len(P)
    if LARGE < k <= _PATIENT:
        T, _, failed = clip_ears(P, np.array([0]), np.array([k]), thorough=True)
        if not len(failed):
            return T
    T = mapbox_earcut.triangulate_float64(np.ascontiguousarray(P), np.array([k], np.uint32))
    if len(T):
        return T.reshape(-1, 3).astype(np.int64)
    return np.stack([np.zeros(k - 2, np.int64), np.arange(1, k - 1), np.arange(2, k)], 1)
