"""Directions that see every face around a vertex from outside."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.types import Floats, Ints

__all__ = ["visible_directions"]

_ENOUGH = 0.25  # cosine to the worst face
_ROUNDS = 40


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
