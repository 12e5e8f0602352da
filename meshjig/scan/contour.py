"""The zero surface of a field on a grid as triangles: one vertex a cube, creases kept."""

from __future__ import annotations

import numpy as np

from meshjig.scan.field import CORNERS, Field, steps
from meshjig.types import Floats, Ints

__all__ = ["contour", "well_composed"]

_ROUNDS = 100
_FLAT = 0.1  # share of the largest eigenvalue below which the planes in a cube don't fix a direction
_INSET = 0.02  # of a cube: a vertex keeps this far from its sides, so that no two meet
_SIDES = np.array([[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]])
_CUBE_EDGES = np.array([[c, c | b] for b in (1, 2, 4) for c in range(8) if not c & b])


def well_composed(field: Field) -> Field:
    """Fill the field, corner by corner, until in every cube the surface is one sheet.

    A cube is ambiguous when on one of its sides the inside meets itself across a diagonal only, or when
    two opposite corners differ from the other six. The outer corner nearest to the surface is then taken
    inside. What remains makes a manifold: one vertex a cube is enough.

    Parameters
    ----------
    field : Field

    Returns
    -------
    Field
    """
    value = field.value.copy()
    known = field
    for _ in range(_ROUNDS):
        corner = known.at(known.cells[:, None] + steps(CORNERS))
        bad = np.flatnonzero(_ambiguous(value[corner] < 0))
        if not len(bad):
            break
        around = np.where(value[corner[bad]] < 0, np.inf, value[corner[bad]])
        around = np.where(_on_bad_side(value[corner[bad]] < 0), around, np.inf)
        value[corner[bad, around.argmin(axis=1)]] = -1e-3 * field.cell
        known = known.follow(value)
        value = known.value.copy()
    return known


def contour(field: Field, foot: Floats, normal: Floats) -> tuple[Floats, Ints, Floats]:
    """Give the zero surface of a field."""
    raise NotImplementedError
