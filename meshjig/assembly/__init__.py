"""The order in which pieces are put together, the way each goes in, and walls that allow it."""

from meshjig.assembly.borders import BorderEdges, border_edges
from meshjig.assembly.peel import Plan, peel
from meshjig.assembly.rulings import wall_angles, wall_directions
from meshjig.assembly.shell_rays import ShellRays
from meshjig.assembly.tilt import needed_tilt, room_to_lean

__all__ = [
    "BorderEdges",
    "Plan",
    "ShellRays",
    "border_edges",
    "needed_tilt",
    "peel",
    "room_to_lean",
    "wall_angles",
    "wall_directions",
]
