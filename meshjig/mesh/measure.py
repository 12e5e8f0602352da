"""Lengths, areas, normals and stretch of triangle meshes."""

from collections.abc import Iterator

import numpy as np

from meshjig.mesh.arrays import Floats, Ints

__all__ = [
    "angle_normals",
    "area_vectors",
    "barycentric",
    "corner_angles",
    "edge_lengths",
    "face_areas",
    "face_sides",
    "interpolate",
    "mesh_volume",
    "prism_volumes",
    "signed_area",
    "singular_values",
    "sums",
    "unit",
    "vertex_normals",
]


_AT_ONCE = 8192  # faces or edges


def unit(x: Floats) -> Floats:
    """Scale rows to length 1; zero rows stay zero."""
    return x / np.maximum(np.linalg.norm(x, axis=-1, keepdims=True), 1e-300)


def area_vectors(V: Floats, F: Ints) -> Floats:
    """Give each face's normal scaled to twice its area, (m, 3)."""
    N = np.empty((len(F), 3))
    for some, (d, e, f), (u, v, w) in face_sides(V, F):
        N[some, 0], N[some, 1], N[some, 2] = e * w - f * v, f * u - d * w, d * v - e * u
    return N


def face_areas(V: Floats, F: Ints) -> Floats:
    """Give each face's area, (m,), mm2; for planar V (n, 2) it is signed."""
    area = np.empty(len(F))
    for some, first, second in face_sides(V, F):
        if V.shape[1] == 2:
            area[some] = first[0] * second[1] - first[1] * second[0]
        else:
            (d, e, f), (u, v, w) = first, second
            area[some] = _length([e * w - f * v, f * u - d * w, d * v - e * u])
    area /= 2
    return area


def edge_lengths(V: Floats, E: Ints) -> Floats:
    """Give the length of each edge (e, 2), mm, (e,)."""
    columns, length = np.ascontiguousarray(V.T), np.zeros(len(E))
    for start in range(0, len(E), _AT_ONCE):
        some = slice(start, start + _AT_ONCE)
        a, b = E[some].T
        for x in columns:
            length[some] += (x.take(b) - x.take(a)) ** 2
    return np.sqrt(length)


def vertex_normals(V: Floats, F: Ints) -> Floats:
    """Give area-weighted unit vertex normals, (n, 3)."""
    N, corners = np.ascontiguousarray(area_vectors(V, F).T), np.ascontiguousarray(F.T)
    out = np.zeros_like(V)
    for axis in range(3):
        for corner in corners:
            out[:, axis] += np.bincount(corner, N[axis], len(V))
    return unit(out)


def angle_normals(V: Floats, F: Ints) -> Floats:
    """Give unit vertex normals weighted by angle, (n, 3): however a surface is split, they stay the same."""
    weighted = corner_angles(V, F)[:, :, None] * unit(area_vectors(V, F))[:, None]
    corner, N = F.ravel(), weighted.reshape(-1, 3)
    return unit(np.stack([np.bincount(corner, x, len(V)) for x in N.T], 1))


def corner_angles(V: Floats, F: Ints) -> Floats:
    """Give the angle at each corner of each face, (m, 3), radians."""
    corner = V[F]
    p, q = corner[:, [1, 2, 0]] - corner, corner[:, [2, 0, 1]] - corner
    return np.arctan2(np.linalg.norm(np.cross(p, q), axis=2), np.einsum("ijk,ijk->ij", p, q))


def mesh_volume(V: Floats, F: Ints) -> float:
    """Give the signed volume of a closed mesh, mm3; positive when faces point outward."""
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def prism_volumes(V: Floats, D: Floats, F: Ints) -> Floats:
    """Give the volume below each face down to V + D, (m,), mm3; positive where D leads inward."""
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    low = V + D
    d, e, f = low[F[:, 0]], low[F[:, 1]], low[F[:, 2]]
    parts = ((b, c, f), (b, f, e), (e, f, d))  # three tetrahedra with a
    return -sum(np.einsum("ij,ij->i", x - a, np.cross(y - a, z - a)) for x, y, z in parts) / 6


def signed_area(ring: Floats) -> float:
    """Give the area inside a closed polyline (n, 2), first point not repeated; > 0 counterclockwise."""
    x, y = ring.T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


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
    stretch = np.empty((len(F), 2))
    in_plane = face_sides(uv, F if F_uv is None else F_uv)
    for (some, d, e), (_, p, q) in zip(face_sides(V, F), in_plane, strict=True):
        length = np.maximum(_length(d), 1e-300)
        axis = [x / length for x in d]
        along = _dot(e, axis)
        height = np.maximum(_length([x - along * y for x, y in zip(e, axis, strict=True)]), 1e-14)
        a, b = p[0] / length, p[1] / length
        c, s = (q[0] - a * along) / height, (q[1] - b * along) / height
        rotation, reflection = np.hypot(a + s, b - c) / 2, np.hypot(a - s, b + c) / 2
        stretch[some, 0], stretch[some, 1] = rotation + reflection, rotation - reflection
    return stretch


def face_sides(X: Floats, F: Ints) -> Iterator[tuple[slice, list[Floats], list[Floats]]]:
    """Give two sides of each face, from its first corner, as lists of coordinates; some faces at a time.

    What is worked out of them then stays in the processor's cache: two to three times as fast.

    Parameters
    ----------
    X : (n, d) float64
    F : (m, 3) int64

    Yields
    ------
    some : slice, of the faces
    first, second : lists of d float64 arrays, from corner 0 to corner 1 and to corner 2
    """
    columns = np.ascontiguousarray(X.T)
    for start in range(0, len(F), _AT_ONCE):
        some = slice(start, start + _AT_ONCE)
        a, b, c = F[some].T
        foot = [x.take(a) for x in columns]
        first, second = ([x.take(k) - y for x, y in zip(columns, foot, strict=True)] for k in (b, c))
        yield some, first, second


def _dot(x: list[Floats], y: list[Floats]) -> Floats:
    total = x[0] * y[0]
    for p, q in zip(x[:0:-1], y[:0:-1], strict=True):  # in einsum's order, so that both round alike
        total += p * q
    return total


def _length(x: list[Floats]) -> Floats:
    return np.sqrt(_dot(x, x))
