"""Creases: edges at which faces meet at an angle that is meant, and normals that keep them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints, connected
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.measure import area_vectors, corner_angles, sums, unit

__all__ = ["CREASE", "CornerNormals", "crease_normals", "split_at_creases"]

CREASE = 0.77  # cosine between two faces below which their edge is a crease: 40 degrees
_LEVEL = 0.9999  # cosine between two faces of one plane: 0.8 degrees
_PLANE = 0.9998  # length of the sum of area vectors over the area: less, and faces bend away little by little


class CornerNormals(NamedTuple):
    """Normals of the vertices of a mesh that was split at its creases."""

    F: Ints  # (m, 3), into the normals
    N: Floats  # (n, 3), unit


def split_at_creases(V: Floats, F: Ints) -> tuple[Ints, Ints]:
    """Double vertices along creases, so that all faces at one of the new vertices go smoothly over.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64; edges of one face, or of more than two, are creases

    Returns
    -------
    F : (m, 3) int64, into the new vertices
    origin : (n',) int64, the old one of each
    """
    return _split(F, unit(area_vectors(V, F)), *_inner_edges(F))


def crease_normals(V: Floats, F: Ints) -> CornerNormals:
    """Give normals to shade a mesh with: flat faces even, round ones smooth, creases sharp.

    Faces that lie in one plane count as one large face, so that slivers in it, or a rounded edge beside it,
    don't turn the normals at its border.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64

    Returns
    -------
    CornerNormals

    Notes
    -----
    A normal is the mean of those of the faces around, by the area of each, or of the plane that it is
    part of, times its angle at the vertex. O(m).
    """
    A = area_vectors(V, F)
    area, N = np.linalg.norm(A, axis=1), unit(A)
    h, twin = _inner_edges(F)
    corner, origin = _split(F, N, h, twin)
    weight = _area_of_plane(A, area, N, h, twin)[:, None] * corner_angles(V, F)
    n = len(origin)
    mean = np.stack([sums(corner.ravel(), (weight * N[:, k, None]).ravel(), n) for k in range(3)], axis=1)
    return CornerNormals(corner, unit(mean))


def _inner_edges(F: Ints) -> tuple[Ints, Ints]:
    """Give one half-edge of every edge of two faces, and the other; (i,) each."""
    twin = edges(F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    return h, twin[h]


def _split(F: Ints, N: Floats, h: Ints, twin: Ints) -> tuple[Ints, Ints]:
    smooth = np.einsum("ij,ij->i", N[h // 3], N[twin // 3]) > CREASE
    h, twin = h[smooth], twin[smooth]
    rows, cols = np.concatenate([h, next_halfedge(h)]), np.concatenate([next_halfedge(twin), twin])
    n, fan = connected(F.size, rows, cols)
    origin = np.empty(n, np.int64)
    origin[fan] = F.ravel()
    return fan.reshape(-1, 3), origin


def _area_of_plane(A: Floats, area: Floats, N: Floats, h: Ints, twin: Ints) -> Floats:
    """Give twice the area of what lies in one plane with each face, (m,), mm2; its own where that bends."""
    a, b = h // 3, twin // 3
    level = np.einsum("ij,ij->i", N[a], N[b]) > _LEVEL
    n, plane = connected(len(A), a[level], b[level])
    whole = sums(plane, area, n)
    length = np.linalg.norm(np.stack([sums(plane, A[:, k], n) for k in range(3)], 1), axis=1)
    return np.where(length > _PLANE * whole, whole, 0)[plane].clip(area)
