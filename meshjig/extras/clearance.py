"""How much room there is between a surface and another one around it."""

from __future__ import annotations

import numpy as np

from meshjig.extras.depth import Depth
from meshjig.mesh.arrays import ranks, row_of
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Room"]

_CREASE = 0.95  # cosine between the faces of a crease; over a flatter one a face hardly sags
_FAR = 1.25  # times the distance that most have; what is farther at first is not looked at again


class Room:
    """Distances from places on a surface, and from the other surface's corners and creases.

    Parameters
    ----------
    parts : list of (k, c) int64
        Places on the surface, as the means of some of its vertices.
    F : (m, 3) int64, the surface
    around : Depth, of the other surface
    spacing : float, mm, between places on the other surface's creases
    """

    def __init__(self, parts: list[Ints], F: Ints, around: Depth, spacing: float) -> None:
        self.F, self._around, self._parts = F, around, parts
        self._depth = [np.full(len(part), np.nan) for part in parts]
        self._outside = _outstanding(around, spacing)
        self._below, self._distance = np.zeros(0, np.int64), np.zeros(0)

    def look_at(self, parts: list[Ints]) -> None:
        """Add other places on the surface; they are measured at the next update."""
        self._parts = [*self._parts, *parts]
        self._depth += [np.full(len(part), np.nan) for part in parts]

    def update(self, V: Floats, moved: Bools) -> None:
        """Measure again where some vertices (n,) have moved; V is (n, 3)."""
        old = [
            np.flatnonzero(moved[part].any(axis=1) | np.isnan(depth))
            for part, depth in zip(self._parts, self._depth, strict=True)
        ]
        points = [V[part[rows]].mean(axis=1) for part, rows in zip(self._parts, old, strict=True)]
        depth = np.split(
            self._around.at(np.concatenate(points))[0], np.cumsum([len(rows) for rows in old])[:-1]
        )
        for known, rows, new in zip(self._depth, old, depth, strict=True):
            known[rows] = new
        first = not len(self._below)
        if first or moved.any():
            inside, self._below, _ = Depth(V, self.F).nearest(self._outside)
            self._distance = -inside
        if first:
            near = self._distance < _FAR * np.median(self._distance)
            self._outside, self._below = self._outside[near], self._below[near]
            self._distance = self._distance[near]

    def at_vertices(self, n: int) -> Floats:
        """Give the least distance that each of n vertices has to do with, inf for none."""
        least = np.full(n, np.inf)
        for part, depth in (
            *zip(self._parts, self._depth, strict=True),
            (self.F[self._below], self._distance),
        ):
            np.minimum.at(least, part.ravel(), np.repeat(depth, part.shape[1]))
        return least

    def too_near(self, V: Floats, least: float) -> Ints:
        """List the faces of the other surface that are nearer than a distance, and those beside them."""
        points = [V[part[d < least]].mean(axis=1) for part, d in zip(self._parts, self._depth, strict=True)]
        face = self._around.nearest(np.concatenate([*points, self._outside[self._distance < least]]))[1]
        twin = edges(self._around.F).twin
        return np.unique([face, *(twin[3 * face + k] // 3 for k in range(3))])


def _outstanding(around: Depth, spacing: float) -> Floats:
    """Give the corners of a surface, and places along the creases that stand out to its inside, (k, 3)."""
    V, F = around.V, around.F
    twin = edges(F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    N = unit(area_vectors(V, F))
    a, b = V[F.ravel()[h]], V[F.ravel()[next_halfedge(h)]]
    tip = V[F.ravel()[next_halfedge(next_halfedge(twin[h]))]]
    crease = np.einsum("ij,ij->i", N[h // 3], N[twin[h] // 3]) < _CREASE
    crease &= np.einsum("ij,ij->i", tip - a, N[h // 3]) > 0
    a, b = a[crease], b[crease]
    count = np.ceil(np.linalg.norm(b - a, axis=1) / spacing).astype(np.int64)
    which = row_of(count)
    return np.concatenate([V, a[which] + ((ranks(count) + 0.5) / count[which])[:, None] * (b - a)[which]])
