"""From a labelled surface to solid pieces."""

from meshjig.solid.directions import miter_directions
from meshjig.solid.enforce_gap import keep_apart
from meshjig.solid.kerf import kerf
from meshjig.solid.pieces import INNER, OUTER, WALL, Solid, solidify
from meshjig.solid.shell import Shell, shell
from meshjig.solid.shell_map import check_thickness, displacement

__all__ = [
    "INNER",
    "OUTER",
    "WALL",
    "Shell",
    "Solid",
    "check_thickness",
    "displacement",
    "keep_apart",
    "kerf",
    "miter_directions",
    "shell",
    "solidify",
]
