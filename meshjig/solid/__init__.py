"""From a labelled surface to solid pieces."""

from meshjig.solid.directions import miter_directions
from meshjig.solid.enforce_gap import enforce_gap
from meshjig.solid.kerf import kerf
from meshjig.solid.local_thickness import check_thickness
from meshjig.solid.offset_sheet import displacement
from meshjig.solid.shell import Shell, shell
from meshjig.solid.solidify import INNER, OUTER, WALL, Solid, solidify

__all__ = [
    "INNER",
    "OUTER",
    "WALL",
    "Shell",
    "Solid",
    "check_thickness",
    "displacement",
    "enforce_gap",
    "kerf",
    "miter_directions",
    "shell",
    "solidify",
]
