"""The surface that lies at one depth inside another, by a grid that is fine only where it passes."""

from __future__ import annotations

import numpy as np

from meshjig.extras.depth import Depth
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import mesh_volume

__all__ = ["inset_surface"]

_LEVELS = 3  # times that cells are halved
_HALF_DIAGONAL = np.sqrt(3) / 2
_CORNERS = np.array([[c & 1, c >> 1 & 1, c >> 2] for c in range(8)], np.int64)
_CYCLE = [0, 1, 3, 2, 4, 5, 7, 6]  # the corners as marching cubes wants them: around the floor, then the top
_SIDES = ([0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7])
_BITS = 20
_OFF = 0.1  # cells: a point nearer to the surface would make for slivers
_SPARE = 1.0  # cells inside the thinnest part that are known as well
_BALLS = 12  # near a point, of which the one that reaches farthest is taken
_BEYOND = 0.75  # cells, by which a ball may reach farther: its middle need not be on the grid
_CUT = 0.25  # cells, how far outside a point is taken to be that was left out


def inset_surface(surface: Depth, depth: float, cell: float, thinnest: float = 0.0) -> tuple[Floats, Ints]:
    """Give the surface at one depth.

    Parameters
    ----------
    surface : Depth
    depth : float, mm
    cell : float, mm, edge of a cube of the grid
    thinnest : float, mm; parts of the inside that are thinner are left out, and where they join thicker ones
        their ends are smooth

    Returns
    -------
    V : (n, 3) float64, mm
    F : (m, 3) int64, oriented outward; without rows where nothing lies so deep

    Notes
    -----
    Depth changes no faster than one goes: cubes whose middle is far from the depth are never divided.
    """
    import igl

    low = surface.V.min(axis=0) - 0.49 * cell
    size = 2**_LEVELS
    radius = thinnest / 2
    spare = max(cell, radius + _SPARE * cell)
    counts = np.ceil((surface.V.max(axis=0) - low) / (cell * size)).astype(np.int64)
    cubes = np.stack(np.meshgrid(*[np.arange(n) for n in counts], indexing="ij"), -1).reshape(-1, 3) * size
    while size > 1:
        found = surface.at(low + cell * (cubes + size / 2))[0]
        band = _HALF_DIAGONAL * size * cell
        cubes = cubes[(found > depth - band) & (found < depth + band + spare)]
        size //= 2
        cubes = (cubes[:, None] + size * _CORNERS).reshape(-1, 3)
    if not len(cubes):
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    corner = cubes[:, None] + _CORNERS[_CYCLE]
    key, of_corner = np.unique(corner @ (1 << _BITS * np.arange(3)), return_inverse=True)
    of_corner = of_corner.reshape(-1, 8).astype(np.int64)
    points = low + cell * np.stack([key >> _BITS * k & (1 << _BITS) - 1 for k in range(3)], -1)
    value = surface.at(points)[0] - depth
    if radius:
        value = _opened(points, value, radius, cell)
    _well_composed(value, of_corner, _CUT * cell)
    above = value[of_corner] > 0
    crossed = above.any(axis=1) & ~above.all(axis=1)
    value = np.where(value > 0, np.maximum(value, _OFF * cell), np.minimum(value, -_OFF * cell))
    V, F, _ = igl.marching_cubes(value, points, np.ascontiguousarray(of_corner[crossed]), 0.0)
    V, F = np.asarray(V), np.asarray(F, np.int64)
    return V, F if mesh_volume(V, F) > 0 else F[:, ::-1]


def _opened(points: Floats, value: Floats, radius: float, cell: float) -> Floats:
    """Hold values (n,) inside to what balls of a radius inside reach, and somewhat beyond.

    The distance to the surface changes no faster than one goes, so the ball around a point is as large as its
    value; where the largest ones end, a thin part is cut off along their smooth hull.
    """
    from scipy.spatial import cKDTree

    thick, rest = np.flatnonzero(value >= radius), np.flatnonzero((value > 0) & (value < radius))
    if not len(thick):
        return np.where(value > 0, -_CUT * cell, value)
    value = value.copy()
    if not len(rest):
        return value
    away, which = cKDTree(points[thick]).query(points[rest], k=min(_BALLS, len(thick)))
    reach = (value[thick][which] - away).reshape(len(rest), -1).max(axis=1)
    value[rest] = np.minimum(value[rest], reach + _BEYOND * cell)
    return value


def _well_composed(value: Floats, of_corner: Ints, out: float) -> None:
    """Take out points inside that touch others by a corner only, where the surface would meet itself.

    On a side of a cube, these are two across from each other with two outside between them.
    """
    while True:
        above = value[of_corner] > 0
        lone = np.zeros_like(above)
        for side in _SIDES:
            a, b, c, d = above[:, side].T
            lone[np.ix_((a == c) & (b == d) & (a != b), side)] = True
        lone &= above
        if not lone.any():
            return
        value[of_corner[lone]] = -out
