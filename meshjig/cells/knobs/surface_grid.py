"""What lies under the plane of cells: the surface's normal and scale on a grid, and widths in space."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.measure import area_vectors, barycentric, face_areas, interpolate, sums, unit
from meshjig.mesh.types import Atlas, Floats, Ints

__all__ = ["Lift", "SurfaceGrid", "surface_grid"]

_MOST = 2_500_000  # cells of the grid
_NEAREST = 8  # faces among which the one that a point lies in is looked for


class SurfaceGrid(NamedTuple):
    """A grid over the plane of an atlas; each of its squares names a row."""

    origin: Floats  # (2,), mm
    step: float  # mm
    row: Ints  # (nx, ny)
    normal: Floats  # (r, 3), unit
    mm: Floats  # (r,)

    def normals(self, points: Floats) -> Floats:
        """Give unit normals at points (..., 2); (..., 3)."""
        return self.normal[self._rows(points)]

    def scale(self, points: Floats) -> Floats:
        """Give how many mm in space one mm of the plane is at points (..., 2)."""
        return self.mm[self._rows(points)]

    def _rows(self, points: Floats) -> Ints:
        at = np.floor((points - self.origin) / self.step).astype(np.int64)
        nx, ny = self.row.shape
        rows: Ints = self.row[np.clip(at[..., 0], 0, nx - 1), np.clip(at[..., 1], 0, ny - 1)]
        return rows


def surface_grid(atlas: Atlas, step: float) -> SurfaceGrid:
    """Average faces over the squares of a grid; squares without a face take the nearest one that has.

    Parameters
    ----------
    atlas : Atlas
    step : float, mm, edge of a square
    """
    from scipy.ndimage import distance_transform_edt

    centre = atlas.uv[atlas.F_uv].mean(1)
    low, high = centre.min(0), centre.max(0)
    step = max(step, float(np.sqrt((high - low).prod() / _MOST)))
    at = np.floor((centre - low) / step).astype(np.int64)
    shape = at.max(0) + 1
    cell = at[:, 0] * shape[1] + at[:, 1]
    full, row = np.unique(cell, return_inverse=True)
    n = len(full)
    normal = area_vectors(atlas.mesh.V, atlas.mesh.F)
    total = np.stack([sums(row, normal[:, k], n) for k in range(3)], 1)
    space = sums(row, np.linalg.norm(normal, axis=1) / 2, n)
    plane = sums(row, np.abs(face_areas(atlas.uv, atlas.F_uv)), n)
    known = (space > 0) & (plane > 0)
    number = np.full(shape, -1)
    number.ravel()[full[known]] = np.arange(known.sum())
    nearest = distance_transform_edt(number < 0, return_distances=False, return_indices=True)
    return SurfaceGrid(
        low, step, number[tuple(nearest)], unit(total[known]), np.sqrt(space[known] / plane[known])
    )


class Lift:
    """Points of an atlas in space; a point in none of the nearest faces takes the plane of one.

    Parameters
    ----------
    atlas : Atlas
    """

    def __init__(self, atlas: Atlas) -> None:
        from scipy.spatial import cKDTree

        self._atlas = atlas
        self._tree: Any = cKDTree(atlas.uv[atlas.F_uv].mean(1), balanced_tree=False, compact_nodes=False)

    def widths(self, pairs: Floats) -> Floats:
        """Give the distance in space between two points (k, 2, 2) each; (k,), mm."""
        p = pairs.reshape(-1, 2)
        uv, F = self._atlas.uv, self._atlas.F_uv
        k = min(_NEAREST, len(F))
        face = self._tree.query(p, k)[1].reshape(len(p), k)
        bary = barycentric(uv, F, face.ravel(), np.repeat(p, k, axis=0)).reshape(len(p), k, 3)
        best = bary.min(2).argmax(1)
        row = np.arange(len(p))
        x = interpolate(self._atlas.mesh.V, self._atlas.mesh.F, face[row, best], bary[row, best])
        return np.linalg.norm(x[0::2] - x[1::2], axis=1)
