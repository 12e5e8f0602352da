"""Which way is inward: offset directions at the vertices of a surface, and such that see all faces there."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import area_vectors, corner_angles, unit
from meshjig.mesh.smoothing import Smoother

__all__ = ["miter_directions", "smooth_normals", "visible_directions"]

_KEEP_NORMAL = 0.02  # weight of the normal against the planes, so that flat fans stay solvable
_ENOUGH = 0.25  # cosine to the worst face
_ROUNDS = 40


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
    w = corner_angles(V, F)
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


def _sum_at_vertices(F: Ints, corner_values: Floats, n: int) -> Floats:
    return np.bincount(F.ravel(), corner_values.ravel(), n).astype(np.float64)


def visible_directions(V: Floats, F: Ints, vertices: Ints, start: Floats) -> Floats:
    """Turn directions until they have a positive part along the normal of every face at their vertex.

    Each round turns a direction towards the normal it sees least; directions that see enough stay.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    vertices : (k,) int64
    start : (k, 3) float64, outward

    Returns
    -------
    (k, 3) float64, unit; the best found where no direction sees all faces

    References
    ----------
    Aubry & Lohner, "On the 'most normal' normal", 2008.
    """
    row = np.full(len(V), -1)
    row[vertices] = np.arange(len(vertices))
    corner = np.flatnonzero(row[F.ravel()] >= 0)
    corner = corner[np.argsort(row[F.ravel()[corner]], kind="stable")]
    owner = row[F.ravel()[corner]]
    normal = unit(area_vectors(V, F[corner // 3]))
    first = np.searchsorted(owner, np.arange(len(vertices)))
    d = unit(start)
    best, best_seen = d.copy(), np.full(len(vertices), -np.inf)
    for k in range(_ROUNDS):
        seen = np.einsum("ij,ij->i", normal, d[owner])
        worst = np.minimum.reduceat(seen, first)
        better = worst > best_seen
        best[better], best_seen[better] = d[better], worst[better]
        if (worst >= _ENOUGH).all():
            break
        at_worst = np.zeros_like(d)
        least = np.flatnonzero(seen <= worst[owner])
        at_worst[owner[least]] = normal[least]
        turn = np.where(worst < _ENOUGH, 0.5 * (_ENOUGH - worst) + 0.3 / (k + 2), 0.0)
        d = unit(d + turn[:, None] * at_worst)
    return best
