"""Which way is inward: offset directions at the vertices of a surface."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.smoothing import Smoother
from meshjig.mesh.types import Floats, Ints

__all__ = ["miter_directions", "smooth_normals"]

_KEEP_NORMAL = 0.02  # weight of the normal against the planes, so that flat fans stay solvable


def miter_directions(V: Floats, F: Ints, cap: float = 2.0) -> Floats:
    """Find for every vertex the outward step that lifts all planes around it by 1.

    At a crease the step is longer than 1, as a carpenter's miter is: V - t d keeps the distance t to both
    sides. Solved by least squares, since more than three planes share no common point.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    cap : float, the longest step

    Returns
    -------
    d : (n, 3) float64; minimises sum w (d . n_f - 1)^2 + 0.02 |d - n|^2 with corner angles as weights w
        that sum to 1 and n the angle-weighted normal
    """
    N = unit(area_vectors(V, F))
    w = _corner_angles(V, F)
    total = np.maximum(_sum_at_vertices(F, w, len(V)), 1e-300)
    rhs = np.stack([_sum_at_vertices(F, w * N[:, [k]], len(V)) for k in range(3)], 1)
    normal = unit(rhs)
    M = np.empty((len(V), 3, 3))
    for i in range(3):
        for j in range(i, 3):
            M[:, i, j] = M[:, j, i] = _sum_at_vertices(F, w * (N[:, i] * N[:, j])[:, None], len(V)) / total
    M += _KEEP_NORMAL * np.eye(3)
    d = np.linalg.solve(M, (rhs / total[:, None] + _KEEP_NORMAL * normal)[:, :, None])[:, :, 0]
    length = np.linalg.norm(d, axis=1)
    return d * np.minimum(1.0, cap / np.maximum(length, 1e-300))[:, None]


def smooth_normals(V: Floats, F: Ints, smoother: Smoother, scale: float) -> Floats:
    """Average the normals over a neighbourhood of about the scale.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    smoother : Smoother of this mesh
    scale : float, mm

    Returns
    -------
    (n, 3) float64, unit, outward
    """
    N = area_vectors(V, F) / 6
    integrals = np.stack([_sum_at_vertices(F, np.repeat(N[:, [k]], 3, 1), len(V)) for k in range(3)], 1)
    return unit(smoother.solve(integrals, scale, start=unit(integrals), tolerance=1e-3))


def _corner_angles(V: Floats, F: Ints) -> Floats:
    corner = V[F]
    p, q = corner[:, [1, 2, 0]] - corner, corner[:, [2, 0, 1]] - corner
    return np.arctan2(np.linalg.norm(np.cross(p, q), axis=2), np.einsum("ijk,ijk->ij", p, q))


def _sum_at_vertices(F: Ints, corner_values: Floats, n: int) -> Floats:
    return np.bincount(F.ravel(), corner_values.ravel(), n).astype(np.float64)
