"""The zero surface of a field as triangles: one vertex a cube, with creases kept."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import area_vectors, sums, unit
from meshjig.scan.field import Field, steps

__all__ = ["Contour", "contour"]

_FLAT = 0.1  # of the largest eigenvalue: what a cube's planes must say of a direction to decide it
_BEYOND = 0.5  # of a cube: how far outside it a vertex may go to where planes meet


class Contour(NamedTuple):
    """Triangles with a vertex in every cube of a field, or near it."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3), facing outward
    middle: Floats  # (n, 3), in the middle of where each cube's edges cross the surface
    centre: Floats  # (n, 3), the middles of the cubes: with its vertices there, no surface crosses itself


def contour(field: Field) -> Contour:
    """Give the surface on which a field is zero.

    Where the surface crosses an edge of the grid, the nearest triangle gives a plane. A cube's vertex is
    where the planes of its edges meet, at least nearly: on a crease, in a corner, or, where they leave a
    direction open, by the middle of the crossings.

    Parameters
    ----------
    field : Field, well composed

    Returns
    -------
    Contour

    References
    ----------
    Ju, Losasso, Schaefer and Warren, "Dual Contouring of Hermite Data", 2002.
    """
    edge, quads = _crossings(field)
    foot, normal = _planes(field, edge)
    n = len(field.cubes)
    cube, at = quads.ravel(), np.repeat(np.arange(len(quads)), 4)
    count = np.bincount(cube, minlength=n)
    middle = _sums(cube, edge[at], n) / count[:, None]
    low = field.points(field.cubes)
    V = middle + _within(_toward_planes(cube, at, foot, normal, middle), middle, low, field.cell)
    return Contour(V, _triangles(V, quads, foot), middle, low + field.cell / 2)


def _crossings(field: Field) -> tuple[Floats, Ints]:
    """Where grid edges cross the surface, (e, 3), and the four cubes around each, (e, 4)."""
    points, quads = [], []
    for axis in range(3):
        x, u, v = (np.eye(3, dtype=np.int64)[(axis + k) % 3] for k in range(3))
        a = field.crossed(axis)
        key = field.key[a]
        b = field.at(key + steps(x))
        t = field.value[a] / (field.value[a] - field.value[b])
        points.append(field.points(key) + field.cell * t[:, None] * x)
        around = np.searchsorted(field.cubes, key[:, None] - [steps(u + v), steps(v), 0, steps(u)])
        leaves = field.value[a] < 0
        quads.append(np.where(leaves[:, None], around, around[:, ::-1]))
    return np.concatenate(points), np.concatenate(quads)


def _planes(field: Field, points: Floats) -> tuple[Floats, Floats]:
    """Give the nearest point of the triangles and their normal there; over holes, the point and no normal."""
    import igl

    squared, face, foot = igl.point_mesh_squared_distance(points, field.V, field.F)
    normal = unit(area_vectors(field.V, field.F[face]))
    away = squared > field.cell**2
    return np.where(away[:, None], points, foot), np.where(away[:, None], 0.0, normal)


def _toward_planes(cube: Ints, at: Ints, foot: Floats, normal: Floats, middle: Floats) -> Floats:
    """The least-squares step from each cube's middle to its planes, (c, 3)."""
    n = normal[at]
    height = np.einsum("kd,kd->k", n, foot[at] - middle[cube])
    A = _sums(cube, np.einsum("ki,kj->kij", n, n).reshape(-1, 9), len(middle)).reshape(-1, 3, 3)
    b = _sums(cube, n * height[:, None], len(middle))
    weight, axes = np.linalg.eigh(A)
    clear = weight > np.maximum(_FLAT * weight[:, 2:], 1e-9)
    along = np.einsum("kdi,kd->ki", axes, b) / np.where(clear, weight, 1.0)
    return np.einsum("kdi,ki->kd", axes, np.where(clear, along, 0.0))


def _within(step: Floats, start: Floats, low: Floats, cell: float) -> Floats:
    """Shorten steps so that they end in their cubes, or not far outside."""
    beyond = _BEYOND * cell
    room = np.where(step > 0, low + cell + beyond - start, start - low + beyond)
    share = (room / np.maximum(np.abs(step), 1e-300)).min(axis=1)
    return step * np.clip(share, 0, 1)[:, None]


def _triangles(V: Floats, quads: Ints, foot: Floats) -> Ints:
    """Halve each quad by the diagonal that runs nearer to the surface."""
    a, b, c, d = quads.T
    first = np.linalg.norm((V[a] + V[c]) / 2 - foot, axis=1)
    second = np.linalg.norm((V[b] + V[d]) / 2 - foot, axis=1)
    turn = (second < first)[:, None]
    one = np.where(turn, np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    other = np.where(turn, np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return np.concatenate([one, other])


def _sums(where: Ints, rows: Floats, n: int) -> Floats:
    return np.stack([sums(where, column, n) for column in rows.T], 1)
