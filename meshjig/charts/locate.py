"""Find the triangle of the plane that a point lies in."""

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.measure import barycentric

__all__ = ["locate"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_OUTSIDE = 1e-9  # barycentric coordinate down to which a point counts as inside


def locate(uv: Floats, F: Ints, points: Floats) -> tuple[Ints, Floats]:
    """Locate points among triangles, by a uniform grid.

    Parameters
    ----------
    uv : (n, 2) float64
    F : (m, 3) int64
    points : (k, 2) float64

    Returns
    -------
    face : (k,) int64, -1 where a point lies in no triangle
    bary : (k, 3) float64, nan there
    """
    face, bary = np.full(len(points), -1, np.int64), np.full((len(points), 3), np.nan)
    if not len(F) or not len(points):
        return face, bary
    low, high = uv[F].min(1), uv[F].max(1)
    origin, cell = low.min(0), max(2 * float(np.mean(high - low)), 1e-12)
    shape = np.floor((high.max(0) - origin) / cell).astype(np.int64) + 1
    row, triangle = _covered_cells((low - origin) / cell, (high - origin) / cell, shape)
    order = np.argsort(row, kind="stable")
    start = np.searchsorted(row[order], np.arange(shape.prod() + 1))

    at = np.floor((points - origin) / cell)
    on_grid = np.flatnonzero((np.isfinite(at) & (at >= 0) & (at < shape)).all(1))
    here = at[on_grid].astype(np.int64) @ np.array([shape[1], 1])
    which, offset = _ranges(start[here + 1] - start[here])
    point, candidate = on_grid[which], triangle[order[start[here][which] + offset]]
    weights = barycentric(uv, F, candidate, points[point])
    depth = weights.min(1)
    best = np.lexsort([-depth, point])
    best = best[np.unique(point[best], return_index=True)[1]]
    best = best[depth[best] >= -_OUTSIDE]
    face[point[best]], bary[point[best]] = candidate[best], weights[best]
    return face, bary


def _covered_cells(low: Floats, high: Floats, shape: Ints) -> tuple[Ints, Ints]:
    """List (cell, box) pairs for boxes given in units of a cell."""
    first = np.floor(low).astype(np.int64)
    n = np.minimum(np.floor(high).astype(np.int64), shape - 1) - first + 1
    box, offset = _ranges(n.prod(1))
    i, j = first[box, 0] + offset // n[box, 1], first[box, 1] + offset % n[box, 1]
    return i * shape[1] + j, box


def _ranges(count: Ints) -> tuple[Ints, Ints]:
    """Give, for every element of ranges of these lengths, its range and its place there."""
    which = np.repeat(np.arange(len(count)), count)
    return which, np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
