"""The way through a thin part below each vertex of the side that owns it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.rays import RayScene

__all__ = ["Ways", "ways_through"]

_FACING = 0.15  # cosine: a face that is turned more from the way is part of the rim
_BELOW = 3e-3  # mm, that rays start below the surface


class Ways(NamedTuple):
    """Ways through, by vertices; zero where there is none."""

    direction: Floats  # (n, 3), unit, outward
    length: Floats  # (n,), mm, to the far side; pieces reach through
    depth: Floats  # (n,), mm, to any other side, also beside what is thick: no hollow is left
    free: Floats  # (n,), mm, from there to what comes next

    def under(self, V: Floats, F: Ints) -> Bools:
        """Mark the faces (m, 3) under which there is a way through at every corner, (m,)."""
        return np.asarray((self.length > 0)[F].all(1) & self._faces_it(V, F))

    def solid(self, V: Floats, F: Ints) -> Bools:
        """Mark the faces (m, 3) under which there is another side at every corner, (m,)."""
        return np.asarray((self.depth > 0)[F].all(1) & self._faces_it(V, F))

    def _faces_it(self, V: Floats, F: Ints) -> Bools:
        facing = np.einsum("ij,ij->i", unit(area_vectors(V, F)), unit(self.direction[F].sum(1)))
        return np.asarray(facing > _FACING)


def ways_through(surface: Mesh, direction: Floats, owns: Bools, far: Bools, limit: float) -> Ways:
    """Follow the way through thin parts to their far side.

    Parameters
    ----------
    surface : Mesh
    direction : (m, 3) float64, unit, the way through towards the side that owns a part; zero elsewhere
    owns, far : (m,) bool, faces of that side, and of the other
    limit : float, mm; longer ways are none

    Returns
    -------
    Ways
        Pieces reach through to far sides, below vertices of which no face is part of anything thick.
    """
    V, F = surface
    n, thin = len(V), direction.any(1)
    total = [np.bincount(F.ravel(), np.repeat(x * surface.areas, 3), n) for x in direction.T]
    at = np.flatnonzero(np.bincount(F[owns].ravel(), minlength=n) > 0)
    d = unit(np.asarray(np.stack(total, 1)[at]))
    scene = RayScene(V, F)
    start = V[at] - _BELOW * surface.vertex_normals[at]
    hit = scene.hits(start, -d)
    face, depth = np.asarray(hit["primID"], np.int64), np.asarray(hit["tfar"], np.float64)
    short = (face >= 0) & (depth < limit)
    at, d, start, face, depth = at[short], d[short], start[short], face[short], depth[short]
    ways = Ways(np.zeros((n, 3)), np.zeros(n), np.zeros(n), np.zeros(n))
    ways.direction[at] = d
    ways.depth[at] = depth
    through = far[face] & (np.bincount(F[~thin].ravel(), minlength=n)[at] == 0)
    ways.length[at[through]] = depth[through]
    ways.free[at] = scene.first_distance(start - (depth + 0.01)[:, None] * d, -d)
    return ways
