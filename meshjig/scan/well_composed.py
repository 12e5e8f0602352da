"""Rid a field of cubes in which its surface is more than one sheet."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.types import Bools, Floats
from meshjig.scan.field import CORNERS, Field, follow, steps

__all__ = ["well_composed"]

_ROUNDS = 1000
_SQUARES = np.array([[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]])


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
    """Give the corner to fill of each cube (c, 8), -1 where it has one sheet."""
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
