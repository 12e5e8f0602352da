"""Flatten a ring without cutting it: a map to the plane that repeats after a period."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.charts.distortion import share_within_limits
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import face_areas, singular_values

__all__ = ["RingMap", "corner_uv", "flatten_ring", "ring_stretch"]


_ITERATIONS = 150
_SETTLED = 1e-6  # relative change of the energy
_WIDTHS = 1 + 0.01 * np.array([0, 1, -1, 2, -2, 3, -3, 4, -4, 6, -6, 8, -8, 10, -10])
_ENOUGH = 0.985  # of the area within limits, to leave the width as it is


class RingMap(NamedTuple):
    """A periodic map: a corner lies where its vertex does, or a period farther along u."""

    uv: Floats  # (n, 2), mm
    period: float  # mm along u


def flatten_ring(V: Floats, F: Ints, left: Bools) -> RingMap:
    """Bring a ring as near to isometry as it gets, with the period among the unknowns.

    The start is conformal: u is harmonic with a jump of one period over the closing line, v its
    conjugate. Then faces are fitted by rotations, and the map to the rotated faces, in turn. Every
    vertex has one unknown place: both sides of the closing line agree for certain.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, a ring that uses every vertex; holes do no harm
    left : (m, 3) bool, corners on the left of a line from one rim to the other, which lie one
        period farther

    Returns
    -------
    RingMap
        Scaled so that the geometric mean of the stretch, weighted by area, is 1. v grows in the
        direction of the line. Faces may come out mirrored: the caller checks.

    References
    ----------
    Liu et al., "A Local/Global Approach to Mesh Parameterization", 2008.
    """
    frames = _Frames(V, F, left)
    uv, period = frames.conformal()
    slope = frames.slopes(uv, period)
    energy = np.inf
    for _ in range(_ITERATIONS):
        turn = np.arctan2(slope[:, 2] - slope[:, 1], slope[:, 0] + slope[:, 3])
        c, s = np.cos(turn), np.sin(turn)
        uv, period = frames.fitted(np.stack([c, -s, s, c], 1))
        slope = frames.slopes(uv, period)
        now = frames.energy(slope, c, s)
        if energy - now < _SETTLED * now:
            break
        energy = now
    area = face_areas(V, F)
    stretch = ring_stretch(V, F, left, RingMap(uv, period))
    log = np.log(np.maximum(stretch[:, 0] * np.abs(stretch[:, 1]), 1e-12))
    scale = float(np.exp(-(area * log).sum() / max(area.sum(), 1e-300) / 2))
    return _within_limits(V, F, left, RingMap(uv * scale, period * scale))


def corner_uv(F: Ints, uv: Floats, left: Bools, period: float) -> tuple[Floats, Ints]:
    """Give each corner its own row: uv (3 m, 2), and the corners (m, 3) into it."""
    rows = uv[F.ravel()].copy()
    rows[left.ravel(), 0] += period
    return rows, np.arange(F.size).reshape(-1, 3)


def ring_stretch(V: Floats, F: Ints, left: Bools, ring: RingMap) -> Floats:
    """The two stretches of each face, (m, 2), as `singular_values` does."""
    return singular_values(V, F, *corner_uv(F, ring.uv, left, ring.period))


def _within_limits(V: Floats, F: Ints, left: Bools, ring: RingMap) -> RingMap:
    """Widen or narrow a map, area kept, where that brings more of it within limits."""
    area = face_areas(V, F)
    best, most = ring, -1.0
    for width in _WIDTHS:
        other = RingMap(ring.uv * [width, 1 / width], ring.period * width)
        share = share_within_limits(area, ring_stretch(V, F, left, other))
        if share > most:
            best, most = other, share
        if most > _ENOUGH:
            break
    return best


class _Frames:
    """The faces laid flat one by one, and the equations that join them over the ring."""

    def __init__(self, V: Floats, F: Ints, left: Bools) -> None:
        from scipy.sparse import csr_matrix, diags
        from scipy.sparse.linalg import splu

        X, Y, area = _gradients(V, F)
        rows = np.repeat(np.arange(len(F)), 3)
        shape = (len(F), len(V))
        self._by_x: Any = csr_matrix((X.ravel(), (rows, F.ravel())), shape=shape)
        self._by_y: Any = csr_matrix((Y.ravel(), (rows, F.ravel())), shape=shape)
        self._jump_x, self._jump_y = (X * left).sum(1), (Y * left).sum(1)  # of a period of 1
        self._area = area
        self._onto_x, self._onto_y = (D.T @ diags(area) for D in (self._by_x, self._by_y))
        laplacian = (self._onto_x @ self._by_x + self._onto_y @ self._by_y).tocsc()
        self._solver = splu(
            laplacian[1:, 1:], permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}
        )  # vertex 0 stays at the origin
        self._of_jump = self._onto_x @ self._jump_x + self._onto_y @ self._jump_y
        self._answer = self._solve(self._of_jump)
        self._stiffness = float((area * (self._jump_x**2 + self._jump_y**2)).sum())
        self._stiffness -= float(self._of_jump @ self._answer)

    def conformal(self) -> tuple[Floats, float]:
        """A conformal map of period 1 with straight rims, scaled to the ring's area."""
        u = -self._answer
        ux, uy = self._by_x @ u + self._jump_x, self._by_y @ u + self._jump_y
        v = self._solve(self._onto_x @ -uy + self._onto_y @ ux)
        period = float(np.sqrt(self._area.sum() / max((self._area * (ux**2 + uy**2)).sum(), 1e-300)))
        return np.stack([u, v], 1) * period, period

    def slopes(self, uv: Floats, period: float) -> Floats:
        """Give u_x, u_y, v_x, v_y of each face, (m, 4)."""
        u, v = uv.T
        ux = self._by_x @ u + period * self._jump_x
        uy = self._by_y @ u + period * self._jump_y
        return np.stack([ux, uy, self._by_x @ v, self._by_y @ v], 1)

    def fitted(self, wanted: Floats) -> tuple[Floats, float]:
        """The map, and the period, whose slopes come nearest to those wanted, (m, 4)."""
        y = self._solve(self._onto_x @ wanted[:, 0] + self._onto_y @ wanted[:, 1])
        pull = float((self._area * (self._jump_x * wanted[:, 0] + self._jump_y * wanted[:, 1])).sum())
        period = (pull - float(self._of_jump @ y)) / self._stiffness
        v = self._solve(self._onto_x @ wanted[:, 2] + self._onto_y @ wanted[:, 3])
        return np.stack([y - period * self._answer, v], 1), period

    def energy(self, slope: Floats, c: Floats, s: Floats) -> float:
        off = (
            (slope[:, 0] - c) ** 2 + (slope[:, 1] + s) ** 2 + (slope[:, 2] - s) ** 2 + (slope[:, 3] - c) ** 2
        )
        return float((self._area * off).sum())

    def _solve(self, right: Floats) -> Floats:
        return np.append(0.0, self._solver.solve(np.asarray(right)[1:]))


def _gradients(V: Floats, F: Ints) -> tuple[Floats, Floats, Floats]:
    """The slope of each corner's hat function along both axes of its face, (m, 3) each; areas."""
    d, e = V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]
    length = np.maximum(np.linalg.norm(d, axis=1), 1e-300)
    ex = np.einsum("ij,ij->i", d, e) / length
    height = np.linalg.norm(e - (ex / length)[:, None] * d, axis=1)
    height = np.maximum(height, 1e-9 * length)
    X = np.stack([-1 / length, 1 / length, np.zeros(len(F))], 1)
    Y = np.stack([(ex / length - 1) / height, -ex / length / height, 1 / height], 1)
    return X, Y, length * height / 2
