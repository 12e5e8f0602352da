"""How deep points lie inside a closed surface."""

from __future__ import annotations

from copy import copy

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, barycentric, unit
from meshjig.mesh.types import Mesh

__all__ = ["Depth"]

_AT_CORNER = 1e-7  # barycentric: nearer to an edge than that is on it
_DOUBTFUL = 1e-6  # of the distance, height over the surface that has no clear sign


class Depth:
    """Distances to a closed surface, positive inside.

    The sign is that of the nearest face, or of the mean of those that meet at the nearest edge or corner,
    each with its angle; the winding number decides where that is in doubt, or everywhere if asked to.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, closed, oriented outward
    crossed : bool
        The surface crosses itself: what it winds around is inside. Twice as slow.
    beside : Mesh, optional
        Another surface, to which distances are measured as well; it may be open, and has no inside.

    References
    ----------
    Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal", 2005.
    """

    def __init__(self, V: Floats, F: Ints, *, crossed: bool = False, beside: Mesh | None = None) -> None:
        import igl

        self._closed = np.ascontiguousarray(F)
        if beside is not None:
            V, F = np.concatenate([V, beside.V]), np.concatenate([F, beside.F + len(V)])
        self.V, self.F = np.ascontiguousarray(V), np.ascontiguousarray(F)
        self._tree = igl.AABB()
        self._tree.init(self.V, self.F)
        self._crossed = crossed
        self._of_face = unit(area_vectors(V, F))
        e = edges(F)
        self._of_halfedge = self._of_face[np.arange(3 * len(F)) // 3] + self._of_face[e.twin // 3]
        self._of_vertex = np.zeros_like(V)
        for k in range(3):
            a, b, c = (V[F[:, (k + j) % 3]] for j in range(3))
            cosine = np.einsum("ij,ij->i", unit(b - a), unit(c - a))
            weighted = np.arccos(np.clip(cosine, -1, 1))[:, None] * self._of_face
            for axis in range(3):
                self._of_vertex[:, axis] += np.bincount(F[:, k], weighted[:, axis], len(V))

    def by_winding(self) -> Depth:
        """Give the same for a surface that crosses itself; see ``crossed``."""
        other = copy(self)
        other._crossed = True
        return other

    def at(self, points: Floats) -> tuple[Floats, Floats]:
        """Give how deep points (k, 3) lie, (k,), and the nearest points of the surface, (k, 3)."""
        depth, _, foot = self.nearest(points)
        return depth, foot

    def nearest(self, points: Floats) -> tuple[Floats, Ints, Floats]:
        """Give how deep points (k, 3) lie, (k,), and the nearest faces (k,) and points (k, 3)."""
        points = np.ascontiguousarray(points)
        squared, face, foot = self._tree.squared_distance(self.V, self.F, points)
        bary = barycentric(self.V, self.F, face, foot)
        normal = self._of_face[face]
        corner = bary.argmin(axis=1)  # its opposite edge starts at the next corner
        on_edge = bary[np.arange(len(face)), corner] < _AT_CORNER
        normal[on_edge] = self._of_halfedge[3 * face[on_edge] + (corner[on_edge] + 1) % 3]
        tip = bary.argmax(axis=1)
        on_vertex = bary[np.arange(len(face)), tip] > 1 - _AT_CORNER
        normal[on_vertex] = self._of_vertex[self.F[face[on_vertex], tip[on_vertex]]]
        distance = np.sqrt(squared)
        height = np.einsum("ij,ij->i", points - foot, unit(normal))
        doubtful = self._crossed | (np.abs(height) < _DOUBTFUL * distance) | (face >= len(self._closed))
        if doubtful.any():
            import igl

            winding = np.asarray(igl.fast_winding_number(self.V, self._closed, points[doubtful]))
            height[doubtful] = 0.5 - winding
        return np.where(height < 0, distance, -distance), face, foot
