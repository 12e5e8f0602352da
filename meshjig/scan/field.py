"""A signed distance field around triangles, on the corners of a grid and only near the surface it bounds."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.scan.resolution import refine_long_edges
from meshjig.types import Bools, Floats, Ints

__all__ = ["CORNERS", "Field", "signed_field"]

CORNERS = np.array([[i, j, k] for k in (0, 1) for j in (0, 1) for i in (0, 1)])  # corner c has bits i, j, k
_SPAN = np.int64(1) << 20  # grid lines an axis that fit into a key
_LONGEST_CAP = 400  # rings of cells that may grow over a hole


class Field(NamedTuple):
    """Values at corners of a grid of cubes."""

    low: Floats  # (3,), where the grid starts
    cell: float  # edge of a cube
    key: Ints  # (k,), known corners, ascending
    value: Floats  # (k,), negative inside; never 0
    far: Bools  # (k,), no triangle is near
    cells: Ints  # (c,), keys of the cubes that the surface passes through, ascending; all corners are known

    def at(self, key: Ints) -> Ints:
        """Give the place of keys among the known corners, -1 for others."""
        return _find(self.key, key)

    def points(self, key: Ints) -> Floats:
        """Give where corners lie, (k, 3)."""
        return self.low + self.cell * _unpack(key)


def signed_field(V: Floats, F: Ints, cell: float) -> Field:
    """Sample the signed distance to the surface that triangles bound, however they cross.

    Inside is where the winding number is over a half, so that faces within the solid don't count, and
    holes are closed by the surface on which it is a half. The field starts from the cubes near triangles
    and follows its own zero surface from there, over holes too.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, coherent, facing outward
    cell : float, edge of a cube, in the units of V

    Returns
    -------
    Field
        Without cells where the triangles bound nothing.

    References
    ----------
    Barill, Dickson, Schmidt, Levin and Jacobson, "Fast Winding Numbers for Soups and Clouds", 2018.
    """
    points, _ = refine_long_edges(V, F, cell)
    low = points.min(axis=0) - 3.49 * cell  # not in line with flat sides of the model
    around = _steps(np.array([[i, j, k] for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]))
    near = np.unique(_pack(np.floor((points - low) / cell).astype(np.int64)))
    key = np.unique((np.unique(near[:, None] + around).ravel()[:, None] + _steps(CORNERS)).ravel())
    value, far = _values(V, F, low + cell * _unpack(key), cell)
    field = Field(low, cell, key, value, far, np.zeros(0, np.int64))
    for _ in range(_LONGEST_CAP):
        crossed = _crossed_cells(field)
        missing = np.unique((crossed[:, None] + _steps(CORNERS)).ravel())
        missing = missing[field.at(missing) < 0]
        if not len(missing):
            return field._replace(cells=crossed)
        value, far = _values(V, F, field.points(missing), cell)
        order = np.argsort(np.concatenate([field.key, missing]), kind="stable")
        field = field._replace(
            key=np.concatenate([field.key, missing])[order],
            value=np.concatenate([field.value, value])[order],
            far=np.concatenate([field.far, far])[order],
        )
    return field


def _values(V: Floats, F: Ints, points: Floats, cell: float) -> tuple[Floats, Bools]:
    """Give the signed distance, and whether it is more than two cells.

    Over a hole the winding number itself takes the place of the sign: the distance would jump there.
    """
    import igl

    squared = igl.point_mesh_squared_distance(points, V, F)[0]
    winding = igl.fast_winding_number(V, F, points)
    distance = np.maximum(np.sqrt(squared), 1e-6 * cell)
    side = np.clip(2 - 4 * winding, -1, 1)
    side = np.where(np.abs(side) < 1e-6, np.where(winding < 0.5, 1e-6, -1e-6), side)
    return side * np.minimum(distance, 2 * cell), distance > 2 * cell


def _crossed_cells(field: Field) -> Ints:
    """Give the cubes around all known grid edges whose ends differ in sign."""
    cells = [np.zeros(0, np.int64)]
    for axis in range(3):
        step = np.eye(3, dtype=np.int64)
        other = field.at(field.key + _steps(step[axis]))
        here = np.flatnonzero(other >= 0)
        here = here[(field.value[here] < 0) != (field.value[other[here]] < 0)]
        u, v = _steps(step[(axis + 1) % 3]), _steps(step[(axis + 2) % 3])
        cells += [field.key[here] - shift for shift in (0, u, v, u + v)]
    return np.unique(np.concatenate(cells))


def _steps(ijk: Ints) -> Ints:
    """Give what to add to a key to go some steps along the axes."""
    return ijk[..., 0] + _SPAN * (ijk[..., 1] + _SPAN * ijk[..., 2])


_pack = _steps


def _unpack(key: Ints) -> Ints:
    return np.stack([key % _SPAN, key // _SPAN % _SPAN, key // (_SPAN * _SPAN)], -1)


def _find(ordered: Ints, wanted: Ints) -> Ints:
    at = np.minimum(np.searchsorted(ordered, wanted), len(ordered) - 1)
    return np.where(ordered[at] == wanted, at, -1)
