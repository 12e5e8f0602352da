"""Lines through a plate that lead through it, and lines that run along it."""

import numpy as np

from meshjig.assembly.shell_rays import REACH, ShellRays
from tests.assembly.sheets import THICK, grid


def test_a_line_leads_through_a_plate_unless_it_is_too_slanted_or_leaves_at_the_side():
    V, F = grid(20, 20)
    rays = ShellRays(V, F, np.tile([0, 0, -THICK], (len(V), 1)))
    half = THICK / 2
    way = half * np.array([[0, 0, -1], [1, 0, -1], [0, 0, -1.01 / REACH], [0, 0, -0.99 / REACH], [1, 0, 0]])
    middle = np.tile([10.3, 10.2, -half], (5, 1))
    assert rays.leads_through(middle, way).tolist() == [True, True, True, False, False]
    beside = np.array([[0.5, 10.2, -half], [0.5, 10.2, -half], [-0.5, 10.2, -half]])
    way = half * np.array([[0.4, 0, -1], [0.6, 0, -1], [0, 0, -1]])
    assert rays.leads_through(beside, way).tolist() == [True, False, False]
