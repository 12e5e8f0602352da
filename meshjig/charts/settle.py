"""Let a flattening that came from a lighter mesh take in the details of its own mesh."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.flatten import FLAT_LIMITS
from meshjig.charts.untangle import faces_around
from meshjig.measure import face_areas, singular_values
from meshjig.topology import border_halfedges, compact

__all__ = ["settle"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_RINGS = 6
_SWEEPS = 12  # of conjugate gradients: details are near, so few reach them
_BACK = 12  # rounds in which mirrored faces draw their surroundings back
_THINNEST = 1e-2  # lesser stretch of a face below which it is drawn back


def settle(V: Floats, F: Ints, uv: Floats, rounds: int = 3, border: Ints | None = None) -> Floats:
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
    bad = (s[:, 1] < FLAT_LIMITS[0]) | (s[:, 0] > FLAT_LIMITS[1])
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
    weight = _cotangents(corners)
    inner = L[free][:, free]
    diagonal = np.maximum(inner.diagonal(), 1e-12 * abs(L.diagonal()).max())[:, None]
    uv = before
    for _ in range(rounds):
        residual = _pull(F, uv, corners, weight) - L @ uv
        uv = uv.copy()
        uv[free] += _roughly_solved(inner, diagonal, residual[free])
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
    """Give half the cotangent of the angle that faces each side, (m, 3); side k runs from corner k."""
    side = np.roll(corners, -1, 1) - corners
    p, q = -np.roll(side, -1, 1), np.roll(side, -2, 1)  # from the corner that faces side k
    cross = np.abs(p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0])
    dot = (p * q).sum(2)
    return np.where(cross > 0, -dot / np.maximum(cross, 1e-300), 0.0) / 2


def _pull(F: Ints, uv: Floats, corners: Floats, weight: Floats) -> Floats:
    """Give the right side of ARAP's equations: every face turned to where it fits best, (n, 2)."""
    side = weight[..., None] * (np.roll(corners, -1, 1) - corners)
    now = np.roll(uv[F], -1, 1) - uv[F]
    a = np.einsum("fkd,fkd->f", side, now)
    b = np.einsum("fk,fk->f", side[..., 0], now[..., 1]) - np.einsum("fk,fk->f", side[..., 1], now[..., 0])
    norm = np.maximum(np.hypot(a, b), 1e-300)
    c, s = (a / norm)[:, None], (b / norm)[:, None]
    turned = np.stack([c * side[..., 0] - s * side[..., 1], s * side[..., 0] + c * side[..., 1]], 2)
    force = np.roll(turned, 1, 1) - turned
    return np.stack([np.bincount(F.ravel(), force[..., d].ravel(), len(uv)) for d in range(2)], 1)


def _roughly_solved(A: Any, diagonal: Floats, b: Floats) -> Floats:
    """Run a few steps of preconditioned conjugate gradients from zero, on both columns at once."""
    x, r = np.zeros_like(b), b.copy()
    z = r / diagonal
    p, rz = z.copy(), (r * z).sum(0)
    for _ in range(_SWEEPS):
        q = A @ p
        alpha = rz / np.maximum((p * q).sum(0), 1e-300)
        x += alpha * p
        r -= alpha * q
        z = r / diagonal
        rz, old = (r * z).sum(0), rz
        p = z + rz / np.maximum(old, 1e-300) * p
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
