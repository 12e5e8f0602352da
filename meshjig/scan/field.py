"""The signed distance to triangles at the corners of a grid, only near the surface that they bound."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.subdivide import refine_long_edges

__all__ = ["CORNERS", "Field", "follow", "signed_field", "steps", "well_composed"]


CORNERS = np.array([[c & 1, c >> 1 & 1, c >> 2] for c in range(8)], np.int64)  # of a cube
_NEAR = 2.0  # cubes, up to which a corner has its distance
_MOST_OVER_HOLES = 0.25  # of the cubes: the surface is open, and need not be known

_ROUNDS = 1000
_SQUARES = np.array([[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]])


class Field(NamedTuple):
    """Values at the known corners of a grid of cubes.

    A key is the number of a corner, and of the cube of which it is the lowest one.
    """

    V: Floats  # (n, 3), whose distance it is
    F: Ints  # (m, 3)
    low: Floats  # (3,), where the grid starts
    cell: float  # edge of a cube
    key: Ints  # (k,), known corners, ascending
    value: Floats  # (k,), negative inside; never 0
    near: Ints  # (q,), ascending keys of the cubes near triangles
    cubes: Ints  # (c,), ascending keys of those that the surface passes through; all their corners are known

    @property
    def over_holes(self) -> float:
        """The share of the surface that no triangle is near, by its cubes."""
        return float(1 - np.isin(self.cubes, self.near).mean()) if len(self.cubes) else 0.0

    def at(self, key: Ints) -> Ints:
        """Give the place of keys among the known corners, -1 for unknown ones."""
        place = np.minimum(np.searchsorted(self.key, key), len(self.key) - 1)
        return np.where(self.key[place] == key, place, -1)

    def points(self, key: Ints) -> Floats:
        """Give where corners lie, (k, 3)."""
        return self.low + self.cell * np.stack([key >> shift & 0xFFFFF for shift in (0, 20, 40)], -1)

    def crossed(self, axis: int) -> Ints:
        """Give the places of known corners behind which, along an axis, the surface is crossed."""
        other = self.at(self.key + steps(np.eye(3, dtype=np.int64)[axis]))
        return np.flatnonzero((other >= 0) & ((self.value < 0) != (self.value[other] < 0)))


def signed_field(V: Floats, F: Ints, cell: float) -> Field:
    """Sample the signed distance to the surface that triangles bound, however they cross.

    Inside is where the winding number is over a half: faces within the solid don't count, and holes are
    closed by the surface on which it is a half.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, facing outward
    cell : float, edge of a cube, in the units of V; more than a millionth of the extent

    Returns
    -------
    Field
        Without cubes where the triangles bound nothing.

    References
    ----------
    Barill, Dickson, Schmidt, Levin and Jacobson, "Fast Winding Numbers for Soups and Clouds", 2018.
    """
    points, _ = refine_long_edges(V, F, cell)
    low = points.min(axis=0) - 3.49 * cell  # flat sides of a model don't fall on the grid
    met = np.unique(steps(np.floor((points - low) / cell).astype(np.int64)))
    near = np.unique(met[:, None] + steps(_offsets(-1, 2)))
    key = np.unique(near[:, None] + steps(CORNERS))
    none = np.zeros(0, np.int64)
    return follow(_with_corners(Field(V, F, low, cell, none, np.zeros(0), near, none), key))


def follow(field: Field) -> Field:
    """Learn corners until the surface is known all around, over holes too, and list its cubes.

    A surface of which too much lies over holes is left unfinished.
    """
    while True:
        field = field._replace(cubes=_crossed_cubes(field))
        missing = np.unique(field.cubes[:, None] + steps(CORNERS))
        missing = missing[field.at(missing) < 0]
        if not len(missing) or field.over_holes > _MOST_OVER_HOLES:
            return field
        field = _with_corners(field, missing)


def steps(ijk: Ints) -> Ints:
    """Give what to add to a key to go some steps along the axes; ijk is (..., 3)."""
    return ijk[..., 0] + (ijk[..., 1] << 20) + (ijk[..., 2] << 40)


def _with_corners(field: Field, key: Ints) -> Field:
    keys = np.concatenate([field.key, key])
    order = np.argsort(keys, kind="stable")
    value = np.concatenate([field.value, _values(field, field.points(key))])
    return field._replace(key=keys[order], value=value[order])


def _values(field: Field, points: Floats) -> Floats:
    """The distance with the winding number as its sign, so far as it is clear.

    Over a hole the distance does not vanish: the value must go through 0 smoothly there.
    """
    import igl

    squared = igl.point_mesh_squared_distance(points, field.V, field.F)[0]
    winding = np.asarray(igl.fast_winding_number(field.V, field.F, points))
    distance = np.clip(np.sqrt(squared), 1e-6 * field.cell, _NEAR * field.cell)
    side = np.clip(2 - 4 * winding, -1, 1)
    return distance * np.where(np.abs(side) < 1e-6, np.where(winding < 0.5, 1e-6, -1e-6), side)


def _crossed_cubes(field: Field) -> Ints:
    """The cubes around all grid edges that cross the surface."""
    cubes = [np.zeros(0, np.int64)]
    for axis in range(3):
        key = field.key[field.crossed(axis)]
        u, v = (steps(np.eye(3, dtype=np.int64)[(axis + k) % 3]) for k in (1, 2))
        cubes += [key - back for back in (0, u, v, u + v)]
    return np.unique(np.concatenate(cubes))


def _offsets(first: int, end: int) -> Ints:
    return np.stack(np.meshgrid(*[np.arange(first, end)] * 3), -1).reshape(-1, 3)


def well_composed(field: Field) -> Field:
    """Fill a field, corner by corner, until the surface passes through every cube as one sheet.

    A cube has more than one where on one of its sides the inside meets itself across a diagonal only, or
    where two opposite corners differ from the other six. Of the outer corners there, the one nearest to
    the surface is taken inside. What remains is a manifold with one vertex a cube.

    Parameters
    ----------
    field : Field

    Returns
    -------
    Field

    References
    ----------
    Latecki, Eckhardt and Rosenfeld, "Well-Composed Sets", 1995.
    """
    for _ in range(_ROUNDS):
        corner = field.at(field.cubes[:, None] + steps(CORNERS))
        fill = _to_fill(field.value[corner])
        bad = np.flatnonzero(fill >= 0)
        if not len(bad):
            break
        value = field.value.copy()
        value[corner[bad, fill[bad]]] = -1e-3 * field.cell
        field = follow(field._replace(value=value))
    return field


def _to_fill(value: Floats) -> np.ndarray:
    """The corner to fill of each cube (c, 8), -1 where it has one sheet."""
    inside = value < 0
    wanted: Bools = np.zeros_like(inside)
    for square in _SQUARES:
        a, b, c, d = inside[:, square].T
        crossed = (a == c) & (b == d) & (a != b)
        wanted[:, square] |= crossed[:, None]
    opposite = inside == inside[:, ::-1]
    count = inside.sum(axis=1)
    lone = opposite.all(axis=1) & ((count == 2) | (count == 6))
    wanted |= lone[:, None]
    wanted &= ~inside
    return np.where(wanted.any(axis=1), np.where(wanted, value, np.inf).argmin(axis=1), -1)
