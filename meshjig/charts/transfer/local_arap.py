"""Let a flattening that came from a proxy take in the details of its own mesh."""

from typing import Any

import numpy as np

from meshjig.charts.distortion import within_limits
from meshjig.charts.flatten.untangle import faces_around
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import border_halfedges, compact
from meshjig.mesh.measure import face_areas, face_sides, singular_values, sums

__all__ = ["local_arap"]


_RINGS = 6
_SWEEPS = 12  # of conjugate gradients: details are near, so few reach them
_BACK = 12  # rounds in which mirrored faces draw their surroundings back
_THINNEST = 1e-2  # lesser stretch of a face below which it is drawn back


def local_arap(V: Floats, F: Ints, uv: Floats, rounds: int = 3, border: Ints | None = None) -> Floats:
    """Bring faces around those that stretch too much nearer to rigid copies.

    A few steps of ARAP whose equations are solved only roughly, by conjugate gradients from the
    given flattening: what a proxy has seen stays, what it has not seen, bumps of a few edges, gets the
    room it needs. Time and memory are linear in the mesh. The border stays, so one that does not
    meet itself does not come to.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm, without mirrored faces
    rounds : int
    border : (b,) int64, its border vertices, where the caller has them

    Returns
    -------
    uv : (n, 2) float64, mm, without mirrored faces where the given one has none

    References
    ----------
    Liu et al., "A Local/Global Approach to Mesh Parameterization", 2008.
    """
    s = singular_values(V, F, uv)
    area = face_areas(V, F)
    bad = ~within_limits(s)
    if not bad.any() or s[:, 1].min() <= 0:
        return uv
    near = faces_around(F, bad, _RINGS)
    H, kept = compact(F[near])
    stays = np.zeros(len(V), bool)
    stays[F[~near].ravel()] = True
    stays[F.ravel()[border_halfedges(F)] if border is None else border] = True
    scale = np.sqrt(face_areas(uv, F).sum() / max(area.sum(), 1e-300))
    uv = uv.copy()
    uv[kept] = _settled(V[kept] * scale, H, uv[kept], ~stays[kept], rounds)
    return uv


def _settled(V: Floats, F: Ints, before: Floats, free: Bools, rounds: int) -> Floats:
    import igl

    corners = _flat_faces(V, F)
    L = -igl.cotmatrix(V, F).tocsr()
    sides = _cotangents(corners)[..., None] * (np.roll(corners, -1, 1) - corners)
    sides = np.ascontiguousarray(sides.transpose(1, 2, 0))
    inner = L[free][:, free]
    diagonal = np.maximum(inner.diagonal(), 1e-12 * abs(L.diagonal()).max())
    uv = before
    for _ in range(rounds):
        residual = (_pull(F, uv, sides) - L @ uv)[free]
        uv = uv.copy()
        for axis in (0, 1):
            uv[free, axis] += _roughly_solved(inner, diagonal, residual[:, axis])
    return _drawn_back(V, F, uv, before)


def _flat_faces(V: Floats, F: Ints) -> Floats:
    """Lay every face flat by itself, (m, 3, 2)."""
    d, e = V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]
    length = np.maximum(np.linalg.norm(d, axis=1), 1e-300)
    x = np.einsum("ij,ij->i", e, d) / length
    y = np.linalg.norm(e - (x / length)[:, None] * d, axis=1)
    flat = np.zeros((len(F), 3, 2))
    flat[:, 1, 0], flat[:, 2, 0], flat[:, 2, 1] = length, x, y
    return flat


def _cotangents(corners: Floats) -> Floats:
    """Half the cotangent of the angle that faces each side, (m, 3); side k runs from corner k."""
    side = np.roll(corners, -1, 1) - corners
    p, q = -np.roll(side, -1, 1), np.roll(side, -2, 1)  # from the corner that faces side k
    cross = np.abs(p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0])
    dot = (p * q).sum(2)
    return np.where(cross > 0, -dot / np.maximum(cross, 1e-300), 0.0) / 2


def _pull(F: Ints, uv: Floats, sides: Floats) -> Floats:
    """The right side of ARAP's equations: every face turned to where it fits best, (n, 2).

    Of the faces laid flat, side k runs from corner k; (3, 2, m), weighted.
    """
    force = np.empty((2, len(F), 3))
    for some, p, q in face_sides(uv, F):
        own = sides[..., some]
        now = [p, [y - x for x, y in zip(p, q, strict=True)], [-x for x in q]]
        a = sum(x * u + y * v for (x, y), (u, v) in zip(own, now, strict=True))
        b = sum(x * v - y * u for (x, y), (u, v) in zip(own, now, strict=True))
        norm = np.maximum(np.hypot(a, b), 1e-300)
        c, s = a / norm, b / norm
        turned = [(c * x - s * y, s * x + c * y) for x, y in own]
        for k in range(3):
            for axis in (0, 1):
                force[axis, some, k] = turned[k - 1][axis] - turned[k][axis]
    return np.stack([sums(F.ravel(), one.ravel(), len(uv)) for one in force], 1)


def _roughly_solved(A: Any, diagonal: Floats, b: Floats) -> Floats:
    """Run a few steps of preconditioned conjugate gradients from zero."""
    x, r = np.zeros_like(b), b.copy()
    z = r / diagonal
    p, rz = z.copy(), (r * z).sum()
    for _ in range(_SWEEPS):
        q = A @ p
        alpha = rz / max((p * q).sum(), 1e-300)
        x += alpha * p
        r -= alpha * q
        z = r / diagonal
        rz, old = (r * z).sum(), rz
        p = z + rz / max(old, 1e-300) * p
    return x


def _drawn_back(V: Floats, F: Ints, uv: Floats, before: Floats) -> Floats:
    """Take vertices of mirrored faces, and in turn those around, back to where they were."""
    for n in range(_BACK):
        bad = singular_values(V, F, uv)[:, 1] < _THINNEST
        bad &= (uv[F] != before[F]).any((1, 2))
        if not bad.any():
            return uv
        back = F[faces_around(F, bad, n // 3)].ravel()
        uv = uv.copy()
        uv[back] = before[back]
    return before
