"""Which triangles cross: exact pairs by CGAL, and how deep they go."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.intersections import crossing_faces
from meshjig.mesh.measure import area_vectors, unit

__all__ = ["at_any_corner", "cell_size", "crossing_pairs", "near"]

_MOST_CELLS = 400  # along the longest side


def crossing_pairs(V: Floats, F: Ints) -> tuple[Ints, Floats]:
    """List the pairs of triangles that pass through each other.

    Triangles that share a vertex or an edge count only if they meet elsewhere too; others that touch at a
    point are listed with depth 0.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64

    Returns
    -------
    pairs : (k, 2) int64
    depth : (k,) float64, mm: how far one triangle reaches beyond the other's plane, the smaller of the two
    """
    none = np.empty((0, 2), np.int64), np.empty(0)
    if not len(F):
        return none
    pairs = crossing_faces(V, F)
    if not len(pairs):
        return none
    a, b = pairs.T
    return pairs, np.minimum(_reach(V, F[a], F[b]), _reach(V, F[b], F[a]))


def near(V: Floats, F: Ints, active: Bools, cell: float) -> Bools:
    """Mark the faces that might touch an active face, by a grid of boxes.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    active : (m,) bool
    cell : float, mm, edge of a box; faces longer than it are always near

    Returns
    -------
    (m,) bool, a superset
    """
    if not active.any():
        return np.zeros(len(F), bool)
    low = V.min(0)
    cell = max(cell, float((V.max(0) - low).max()) / _MOST_CELLS)
    box = ((V - low) / cell).astype(np.int64) + 1
    sides = box.max(0) + 2
    key = (box[:, 0] * sides[1] + box[:, 1]) * sides[2] + box[:, 2]
    taken = np.zeros(int(sides.prod()), bool)
    around = np.arange(-1, 2)
    steps = ((around[:, None] * sides[1] + around)[:, :, None] * sides[2] + around).ravel()
    taken[(np.unique(key[F[active].ravel()])[:, None] + steps).ravel()] = True
    return at_any_corner(taken[key], F) | _large(V, F, cell)


def cell_size(V: Floats, F: Ints, thickness: float) -> float:
    """Give the edge of a box, mm, that all but a few faces fit into."""
    length = np.linalg.norm(V[F[:, 1]] - V[F[:, 0]], axis=1)
    return max(0.25 * thickness, 1.25 * float(np.percentile(length, 98)))


def at_any_corner(mark: Bools, F: Ints) -> Bools:
    """Mark faces with a marked vertex; much quicker than any(1) on three columns."""
    return mark[F[:, 0]] | mark[F[:, 1]] | mark[F[:, 2]]


def _large(V: Floats, F: Ints, cell: float) -> Bools:
    large = np.zeros(len(F), bool)
    for x in np.ascontiguousarray(V.T):
        a, b, c = x[F[:, 0]], x[F[:, 1]], x[F[:, 2]]
        large |= np.maximum(np.maximum(a, b), c) - np.minimum(np.minimum(a, b), c) > cell
    return large


def _reach(V: Floats, A: Ints, B: Ints) -> Floats:
    """Give how far triangles A stand out on the lesser side of the planes of triangles B."""
    n = unit(area_vectors(V, B))
    height = np.einsum("kij,kj->ki", V[A] - V[B[:, :1]], n)
    return np.maximum(0.0, np.minimum(height.max(1), -height.min(1)))
