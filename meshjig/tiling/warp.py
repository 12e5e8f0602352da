"""Random bending of a chart's plane, so that no two tiles are alike."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from meshjig.mesh.arrays import Floats, Ints

__all__ = ["Warp", "WarpStyle", "random_warp"]

WarpStyle = Literal["bspline", "bilinear"]

_DEGREE = {"bspline": 3, "bilinear": 1}
# how far a control point moves at random = 1, in distances of control points; a cubic evens moves out
_MOVE = {"bspline": 0.85, "bilinear": 0.45}
LEAST = 0.35  # of the area of a sample, that is left of it
SAMPLES = 6  # a distance of control points
SHRINK = 0.8


@dataclass(frozen=True)
class Warp:
    """A map of the plane: the identity plus a tensor product B-spline within a box.

    On the box's border and beyond, it is the identity; with a period, it repeats along u instead.
    """

    low: Floats  # (2,), mm, the box's lowest corner
    extent: Floats  # (2,), mm
    moves: Floats  # (m, n, 2), mm, of the control points
    degree: int
    periodic: bool

    def __call__(self, points: Floats) -> Floats:
        """Map points (..., 2), mm."""
        place = (points.reshape(-1, 2) - self.low) / self.extent
        place[:, 1] = np.clip(place[:, 1], 0, 1)
        place[:, 0] = place[:, 0] % 1.0 if self.periodic else np.clip(place[:, 0], 0, 1)
        row, of_row = _basis(place[:, 0], self.moves.shape[0], self.degree, self.periodic)
        column, of_column = _basis(place[:, 1], self.moves.shape[1], self.degree, False)
        moved = np.zeros((len(place), 2))
        for i in range(self.degree + 1):
            for j in range(self.degree + 1):
                weight = of_row[:, i] * of_column[:, j]
                moved += weight[:, None] * self.moves[row[:, i], column[:, j]]
        warped: Floats = points + moved.reshape(points.shape)
        return warped


def random_warp(
    bounds: Floats,
    tile: float,
    amount: float,
    style: WarpStyle,
    rng: np.random.Generator,
    period: float = 0.0,
) -> Warp | None:
    """Move the control points of a map of a box at random, as far as it stays one-to-one.

    Parameters
    ----------
    bounds : (4,) float64, mm, the box: u0, v0, u1, v1; its border stays where it is
    tile : float, mm, the distance of control points is about that
    amount : float, 0 to 1
    style : "bspline", cubic and smooth, or "bilinear"
    rng : numpy Generator
    period : float, mm; not 0, the map repeats after it along u

    Returns
    -------
    Warp or None, where there is nothing to move

    Notes
    -----
    Sampled finely, no part of the plane shrinks below 35 % of its area: moves are made
    smaller until that holds.

    References
    ----------
    Elber and Kim, "Synthesis of 3D Jigsaw Puzzles over Freeform 2-Manifolds", the maps R_M.
    """
    degree = _DEGREE[style]
    low = np.asarray(bounds[:2], dtype=np.float64)
    extent = np.asarray(bounds[2:]) - low
    if period:
        extent[0] = period
    n = np.maximum(np.rint(extent / tile).astype(int), 1)
    angle = rng.uniform(0, 2 * np.pi, n + 1)
    length = np.sqrt(rng.uniform(0, 1, n + 1)) * amount * _MOVE[style]
    moves = np.stack([np.cos(angle), np.sin(angle)], -1) * length[..., None] * (extent / n)
    moves[:, [0, -1]] = 0
    if period:
        moves = moves[:-1]
    else:
        moves[[0, -1]] = 0
    if not moves.any():
        return None
    if degree > 1:  # mirrored beyond the border, moves cancel out on it
        moves = np.pad(moves, ((1 - bool(period),) * 2, (1, 1), (0, 0)), mode="reflect", reflect_type="odd")
    warp = Warp(low, extent, moves, degree, period > 0)
    while _least_share(warp, n) < LEAST:
        moves *= SHRINK
    return warp


def _basis(t: Floats, n: int, degree: int, periodic: bool) -> tuple[Ints, Floats]:
    """The control points (k, degree + 1), of n, that act at t (k,) in 0..1, and their weights."""
    from scipy.interpolate import BSpline

    cells = n if periodic else n - degree
    knots = np.arange(-degree, cells + degree + 1) / cells
    weights = BSpline.design_matrix(np.clip(t, 0, 1), knots, degree)
    at = weights.indices.reshape(-1, degree + 1).astype(np.int64)
    return at % n, weights.data.reshape(-1, degree + 1)


def _least_share(warp: Warp, n: Ints) -> float:
    """The least area that is left of a sample triangle, as a share of its own."""
    u, v = (np.linspace(0, 1, SAMPLES * int(k) + 1) for k in n)
    grid = np.stack(np.meshgrid(u, v, indexing="ij"), -1) * warp.extent + warp.low
    if warp.periodic:
        grid[-1, :, 0] -= 1e-9 * warp.extent[0]  # the end of the period is not its start
    moved = warp(grid)
    a, b, c, d = moved[:-1, :-1], moved[1:, :-1], moved[1:, 1:], moved[:-1, 1:]
    corners = [_cross(b - a, c - a), _cross(c - a, d - a), _cross(b - a, d - a), _cross(c - b, d - b)]
    whole = float(np.prod(warp.extent / n)) / SAMPLES**2
    return float(min(x.min() for x in corners)) / whole


def _cross(p: Floats, q: Floats) -> Floats:
    return p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0]
