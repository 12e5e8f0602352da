"""How thick a wall can be at all: half the way through the model, by rays."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import area_vectors, face_areas
from meshjig.mesh.rays import RayScene

__all__ = ["inward_room", "thin_share"]

_SHARE = 0.45  # of the way through the model; two walls meet at half
_FAR = 1e9  # mm
_TILT = np.deg2rad(35.0)
_OPPOSITE = -0.7  # cosine between normals: a tilted ray counts when it ends on a surface that faces back


def inward_room(V: Floats, F: Ints, d: Floats, enough: float = np.inf) -> Floats:
    """Measure how deep a wall may go at each vertex before it meets the one from the other side.

    One ray goes straight inward. Four tilted rays find what it misses behind folds and in corners.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, oriented outward
    d : (n, 3) float64, unit, outward
    enough : float, mm; tilted rays need not find out whether there is more room than that

    Returns
    -------
    (n,) float64, mm: 0.45 of the free way; inf where nothing lies across, as on an open surface

    Notes
    -----
    Rays start a little below the surface, and a hit is measured in the hit face's plane in float64, since
    Embree works in float32.
    """
    scene = RayScene(V, F)
    N = area_vectors(V, F)
    N /= np.maximum(np.linalg.norm(N, axis=1), 1e-300)[:, None]
    origin = V - 1e-3 * d
    side, across = _frame(d)
    depth = np.full(len(V), np.inf)
    for angle, around in [(0.0, 0.0), *((_TILT, k * np.pi / 2) for k in range(4))]:
        ray = -np.cos(angle) * d + np.sin(angle) * (np.cos(around) * side + np.sin(around) * across)
        far = min(enough / _SHARE / np.cos(angle), _FAR) if angle else _FAR
        face = scene.first_face(origin, ray, np.full(len(V), far))
        hit = np.flatnonzero(face >= 0)
        n = N[face[hit]]
        facing = np.einsum("ij,ij->i", ray[hit], n)
        way = np.einsum("ij,ij->i", V[F[face[hit], 0]] - origin[hit], n) / np.where(
            facing > 1e-6, facing, np.inf
        )
        valid = (facing > 1e-6) & (way > 0)
        if angle:
            valid &= np.einsum("ij,ij->i", n, d[hit]) < _OPPOSITE
        depth[hit[valid]] = np.minimum(depth[hit[valid]], way[valid] * np.cos(angle))
    return _SHARE * depth


def thin_share(V: Floats, F: Ints, thin: Bools) -> float:
    """Give the share of the area at vertices that are marked thin."""
    area = face_areas(V, F)
    return float((area * thin[F].mean(1)).sum() / max(area.sum(), 1e-300))


def _frame(d: Floats) -> tuple[Floats, Floats]:
    """Give two unit vectors at right angles to unit d."""
    axis = np.eye(3)[np.abs(d).argmin(1)]
    side = np.cross(d, axis)
    side /= np.maximum(np.linalg.norm(side, axis=1), 1e-300)[:, None]
    return side, np.cross(d, side)
