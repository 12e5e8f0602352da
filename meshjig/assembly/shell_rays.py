"""How far it is from within a shell to its sheets."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.rays import RayScene

__all__ = ["REACH", "ShellRays"]

REACH = 2.6  # of half the thickness, within which a wall must meet a sheet


class ShellRays:
    """Rays from the middle of a shell to both of its sheets."""

    def __init__(self, V: Floats, F: Ints, D: Floats) -> None:
        self._sheets = [(RayScene(V, F), -1), (RayScene(V + D, F), 1)]

    def leads_through(self, middle: Floats, way: Floats) -> Bools:
        """Tell of lines through points which meet both sheets before long, (k,).

        Parameters
        ----------
        middle : (k, 3) float64, mm, half way between the sheets
        way : (k, 3) float64, mm, to the inner sheet if that is level; back to the outer one
        """
        far = [scene.first_distance(middle, sign * way) <= REACH for scene, sign in self._sheets]
        return np.asarray(far[0] & far[1])
