"""What is repeated: a few tiles whose copies by two translations cover the plane."""

from collections.abc import Callable
from dataclasses import dataclass

from meshjig.mesh.types import Floats, Ints
from meshjig.tiling.template import Template

__all__ = ["Unit"]


@dataclass(frozen=True)
class Unit:
    """Tiles, corners and edges of one translational unit, in lengths at which the mean tile has area 1.

    Row k of an array with three columns names corner or tile k[0], moved k[1] times by the first
    translation and k[2] times by the second.
    """

    translations: Floats  # (2, 2), a vector a row, the second on the left of the first
    corners: Floats  # (c, 2), where tiles meet
    ends: Ints  # (e, 2, 3), the corners where an edge starts and stops
    sides: Ints  # (e, 2, 3), the tiles on its left and on its right
    n_tiles: int
    curves: tuple[Floats, ...] | None = None
    """A polyline (n, 2) an edge, both its ends included, where tiles interlock by their shape."""

    template: Callable[[int], Template] | None = None
    """Where edges are straight instead: the knob that they carry, drawn with n points a part."""

    knob_side: Ints | None = None
    """(e,), 1: an edge's knob points to its left, -1: to its right, 0: to either."""
