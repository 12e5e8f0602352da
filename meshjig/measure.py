"""Lengths, areas, normals and stretch of triangle meshes."""

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "area_vectors",
    "barycentric",
    "face_areas",
    "interpolate",
    "mesh_volume",
    "singular_values",
    "sums",
    "unit",
    "vertex_normals",
]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_BLOCK = 8192  # faces: what is worked on stays in the cache


def unit(x: Floats) -> Floats:
    """Scale rows to length 1; zero rows stay zero."""
    return x / np.maximum(np.linalg.norm(x, axis=-1, keepdims=True), 1e-300)


def area_vectors(V: Floats, F: Ints) -> Floats:
    """Give each face's normal scaled to twice its area, (m, 3)."""
    N = np.empty((len(F), 3))
    for k in range(0, len(F), _BLOCK):
        G, n = F[k : k + _BLOCK], N[k : k + _BLOCK]
        a = V[G[:, 0]]
        (d, e, f), (u, v, w) = (V[G[:, 1]] - a).T, (V[G[:, 2]] - a).T
        n[:, 0], n[:, 1], n[:, 2] = e * w - f * v, f * u - d * w, d * v - e * u
    return N


def face_areas(V: Floats, F: Ints) -> Floats:
    """Give each face's area, (m,), mm2; for planar V (n, 2) it is signed."""
    if V.shape[1] == 2:
        d, e = V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]
        return (d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]) / 2
    return _lengths(area_vectors(V, F)) / 2


def vertex_normals(V: Floats, F: Ints) -> Floats:
    """Give area-weighted unit vertex normals, (n, 3)."""
    N = area_vectors(V, F)
    out = np.zeros_like(V)
    for k in range(3):
        for axis in range(3):
            out[:, axis] += np.bincount(F[:, k], N[:, axis], len(V))
    return unit(out)


def mesh_volume(V: Floats, F: Ints) -> float:
    """Give the signed volume of a closed mesh, mm3; positive when faces point outward."""
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def interpolate(X: Floats, F: Ints, face: Ints, bary: Floats) -> Floats:
    """Carry per-vertex values X (n, d) to points (face, bary (k, 3)); (k, d)."""
    return np.einsum("kj,kjd->kd", bary, X[F[face]])


def sums(where: Ints, values: Floats, n: int) -> Floats:
    """Add up values (k,) by where they belong (k,), one of n places; (n,)."""
    return np.bincount(where, values, n).astype(np.float64)


def barycentric(V: Floats, F: Ints, face: Ints, points: Floats) -> Floats:
    """Give the barycentric coordinates of points in the planes of their faces.

    Parameters
    ----------
    V : (n, d) float64, d is 2 or 3
    F : (m, 3) int64
    face : (k,) int64
    points : (k, d) float64

    Returns
    -------
    bary : (k, 3) float64, rows sum to 1; a face without area answers its first corner
    """
    a = V[F[face, 0]]
    d, e, p = V[F[face, 1]] - a, V[F[face, 2]] - a, points - a
    dd, de, ee = (np.einsum("ij,ij->i", x, y) for x, y in ((d, d), (d, e), (e, e)))
    pd, pe = np.einsum("ij,ij->i", p, d), np.einsum("ij,ij->i", p, e)
    det = dd * ee - de * de
    flat = det <= 1e-28 * np.maximum(dd, ee) ** 2
    det = np.where(flat, 1.0, det)
    v = np.where(flat, 0.0, (ee * pd - de * pe) / det)
    w = np.where(flat, 0.0, (dd * pe - de * pd) / det)
    return np.stack([1 - v - w, v, w], 1)


def singular_values(V: Floats, F: Ints, uv: Floats, F_uv: Ints | None = None) -> Floats:
    """Give the stretch of the map from each face to the plane.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    uv : (k, 2) float64
    F_uv : (m, 3) int64, corners into uv; F itself when each vertex has one place in the plane

    Returns
    -------
    (m, 2) float64, larger first; the second is negative where the face is mirrored
    """
    G = F if F_uv is None else F_uv
    d, e = V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]
    length = np.maximum(_lengths(d), 1e-300)
    x = d / length[:, None]
    ex = np.einsum("ij,ij->i", e, x)
    ey = np.maximum(_lengths(e - ex[:, None] * x), 1e-14)
    p, q = uv[G[:, 1]] - uv[G[:, 0]], uv[G[:, 2]] - uv[G[:, 0]]
    first = p / length[:, None]
    second = (q - first * ex[:, None]) / ey[:, None]
    rotation = np.hypot(first[:, 0] + second[:, 1], first[:, 1] - second[:, 0]) / 2
    reflection = np.hypot(first[:, 0] - second[:, 1], first[:, 1] + second[:, 0]) / 2
    return np.stack([rotation + reflection, rotation - reflection], 1)


def _lengths(X: Floats) -> Floats:
    """Give the length of each row, (k,); quicker than numpy's norm."""
    return np.sqrt(np.einsum("ij,ij->i", X, X))
