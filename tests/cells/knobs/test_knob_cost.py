"""Knobs conflict exactly when their discs come too near each other, or to a root."""

import numpy as np
import shapely

from meshjig.cells.knobs.knob_borders import cell_borders
from meshjig.cells.knobs.knob_cost import conflicts
from meshjig.cells.knobs.knob_curves import placed
from meshjig.cells.knobs.knob_places import Obstacles
from meshjig.cells.knobs.knob_shapes import SLIM, knob_shapes
from meshjig.cells.knobs.surface_grid import surface_grid
from tests.cells.knobs.knob_sheets import EDGE, square_cells

CLEAR = 1.4


def standing():
    """Knobs of several sizes at random places of squares' borders."""
    rng = np.random.default_rng(1)
    atlas = square_cells(3)
    b = cell_borders(atlas)
    shapes = knob_shapes(rng, 0.5, 12)
    obstacles = Obstacles(b, b.lines(), b.others(), b.rims(), surface_grid(atlas, 1.0), shapes, CLEAR, 0.0)
    side = rng.integers(0, len(b.cell), 400)
    place = b.along[b.span[side, 0]] + EDGE * rng.uniform(0.25, 0.75, 400)
    shape = rng.choice(shapes.of_kind(SLIM), 400)
    return obstacles, placed(b, obstacles.grid, side, place, shape, rng.uniform(1.0, 3.7, 400))


def test_near_knobs_clash_and_far_ones_do_not():
    obstacles, c = standing()
    knob = shapely.polygons(c.drawn(obstacles.shapes.points[c.shape]))
    cell, border = obstacles.borders.cell[c.side], obstacles.borders.border[c.side]
    squares = shapely.convex_hull(obstacles.borders.rims())[obstacles.borders.rim[c.side]]
    knob = shapely.intersection(knob, squares)
    found = {tuple(pair) for pair in conflicts(obstacles, c).tolist()}
    i, j = np.triu_indices(len(cell), 1)
    together = (cell[i] == cell[j]) & (border[i] != border[j])
    i, j = i[together], j[together]
    gap = shapely.distance(knob[i], knob[j])
    conflict = np.array([pair in found for pair in zip(i.tolist(), j.tolist(), strict=True)])
    assert conflict[gap < CLEAR].all()  # discs cover knobs
    assert not conflict[gap > CLEAR + 0.6 * 3.7].any()  # and are not much larger
    assert 100 < conflict.sum() < len(conflict) - 100


def test_knobs_do_not_hang_on_a_thread():
    obstacles, c = standing()
    b = obstacles.borders
    found = {tuple(pair) for pair in conflicts(obstacles, c).tolist()}
    foot = shapely.points(c.middle)
    tip = shapely.points(c.drawn(obstacles.shapes.discs[c.shape][:, 2:, :2])[:, 0])
    origin = np.array([[cell // 3, cell % 3] for cell in range(9)]) * EDGE
    near = 0
    for i in range(len(c.side)):
        # the root of i, as seen in the cell that it leaves, which lies one EDGE farther off in the plane
        home = b.cell[b.opposite(c.side[[i]])[0]]
        root = shapely.points(shapely.get_coordinates(foot[i])[0] - origin[b.cell[c.side[i]]] + origin[home])
        for j in np.flatnonzero((b.cell[c.side] == home) & (b.border[c.side] != b.border[c.side[i]])):
            if shapely.distance(root, tip[j]) < CLEAR + 0.6 * c.radius[i] + c.radius[j]:
                near += 1
                assert (min(i, int(j)), max(i, int(j))) in found
    assert near > 20
