"""How far points under a surface are from it, as the crow flies or from the planes of its faces."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, ragged, row_of, starts
from meshjig.mesh.measure import area_vectors, barycentric, unit

__all__ = ["SurfaceDistance"]

_SURE = 0.05  # mm; nearer points move along the normal
_ON_RIM = 1e-6  # a barycentric coordinate below it puts a point on the opposite edge


class SurfaceDistance:
    """Distances to a mesh, many times over: its tree of boxes is built once.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, oriented; points are asked for on its back
    """

    def __init__(self, V: Floats, F: Ints) -> None:
        import igl

        self._V, self._F = V, F
        self._tree = igl.AABB()
        self._tree.init(V, F)
        self._normal = unit(area_vectors(V, F))
        self._corner_face = np.argsort(F.ravel(), kind="stable") // 3  # faces by vertex
        self._first = np.concatenate([[0], np.cumsum(np.bincount(F.ravel(), minlength=len(V)))])

    def distance(self, points: Floats) -> Floats:
        """Give the distances of points (k, 3) to the surface, (k,), mm."""
        return self.nearest(points)[0]

    def nearest(self, points: Floats) -> tuple[Floats, Ints, Floats]:
        """Find the nearest points of the surface.

        Returns
        -------
        distance : (k,) float64, mm
        face : (k,) int64
        foot : (k, 3) float64, mm
        """
        squared, face, foot = self._tree.squared_distance(self._V, self._F, points)
        return np.sqrt(squared), face, foot

    def to_depth(
        self, points: Floats, depth: Floats, share: float, most: float, slack: float = 1.1
    ) -> Floats:
        """Move points to a depth behind the surface: down to it, and up to a little more.

        Parameters
        ----------
        points : (k, 3) float64, mm
        depth : (k,) float64, mm
        share : float, of the way there
        most : float, mm, to move a point by if the share is 1
        slack : float, of the depth, that points may be at

        Returns
        -------
        (k, 3) float64, mm; points in front of the surface move back through it
        """
        distance, face, foot = self.nearest(points)
        height = np.einsum("ij,ij->i", points - foot, self._normal[face])
        behind = height < 0
        sure = (behind & (distance > _SURE))[:, None]
        way = np.where(sure, (points - foot) / np.maximum(distance, _SURE)[:, None], -self._normal[face])
        signed = np.where(behind, distance, -distance)
        step = np.clip(signed, depth, slack * depth) - signed
        return points + share * np.clip(step, -most, most)[:, None] * way

    def behind_planes(self, points: Floats, cap: float = 2.0) -> tuple[Floats, Floats]:
        """Measure how deep points lie under the planes that meet where the surface is nearest.

        Where all points of one depth form a sheet, it has sharp creases: a mitered join. It equals the
        distance but under reentrant creases and corners, where the distance gives a rounded join.

        Parameters
        ----------
        points : (k, 3) float64, mm
        cap : float, the longest miter: no depth is less than the distance over it

        Returns
        -------
        depth : (k,) float64, mm, the largest under one of the planes
        distance : (k,) float64, mm
        """
        distance, face, foot = self.nearest(points)
        inside = barycentric(self._V, self._F, face, foot) > _ON_RIM
        rim = np.flatnonzero(~inside.all(1))
        depth = distance.copy()
        if len(rim):
            depth[rim] = np.maximum(distance[rim] / cap, self._deepest(points, rim, face, inside))
        return np.minimum(depth, distance), distance

    def _deepest(self, points: Floats, rim: Ints, face: Ints, inside: Bools) -> Floats:
        """Give the depth of points[rim] under the faces that share the edge or corner they are nearest to."""
        start = self._first
        nearest_corner = inside[rim].argmax(1)
        v = self._F[face[rim], nearest_corner]
        count = start[v + 1] - start[v]
        owner, around = row_of(count), self._corner_face[ragged(start[v], count)]
        edge = inside[rim].sum(1) == 2
        other = self._F[face[rim], 2 - inside[rim][:, ::-1].argmax(1)]
        shares = (self._F[around] == other[owner][:, None]).any(1) | ~edge[owner]
        height = np.einsum("ij,ij->i", self._V[v[owner]] - points[rim[owner]], self._normal[around])
        return np.maximum.reduceat(np.where(shares, height, -np.inf), starts(count))
