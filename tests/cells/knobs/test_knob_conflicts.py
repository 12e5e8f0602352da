"""Knobs clash exactly when their discs come too near each other, or to a root."""

import numpy as np
import shapely

from meshjig.cells.knobs.knob_borders import cell_borders
from meshjig.cells.knobs.knob_conflicts import clashes
from meshjig.cells.knobs.knob_obstacles import Room, stood
from meshjig.cells.knobs.knob_shapes import SLIM, knob_shapes
from meshjig.cells.knobs.surface_grid import survey
from tests.cells.knobs.knob_sheets import EDGE, square_cells

CLEAR = 1.4


def standing():
    """Knobs of several sizes at random places of squares' borders."""
    rng = np.random.default_rng(1)
    atlas = square_cells(3)
    b = cell_borders(atlas)
    shapes = knob_shapes(rng, 0.5, 12)
    room = Room(b, b.lines(), b.others(), b.rims(), survey(atlas, 1.0), shapes, CLEAR, 0.0)
    side = rng.integers(0, len(b.cell), 400)
    place = b.along[b.span[side, 0]] + EDGE * rng.uniform(0.25, 0.75, 400)
    shape = rng.choice(shapes.of_kind(SLIM), 400)
    return room, stood(b, room.ground, side, place, shape, rng.uniform(1.0, 3.7, 400))


def test_near_knobs_clash_and_far_ones_do_not():
    room, c = standing()
    knob = shapely.polygons(c.drawn(room.shapes.points[c.shape]))
    cell, border = room.borders.cell[c.side], room.borders.border[c.side]
    squares = shapely.convex_hull(room.borders.rims())[room.borders.rim[c.side]]
    knob = shapely.intersection(knob, squares)
    found = {tuple(pair) for pair in clashes(room, c).tolist()}
    i, j = np.triu_indices(len(cell), 1)
    together = (cell[i] == cell[j]) & (border[i] != border[j])
    i, j = i[together], j[together]
    gap = shapely.distance(knob[i], knob[j])
    clash = np.array([pair in found for pair in zip(i.tolist(), j.tolist(), strict=True)])
    assert clash[gap < CLEAR].all()  # discs cover knobs
    assert not clash[gap > CLEAR + 0.6 * 3.7].any()  # and are not much larger
    assert 100 < clash.sum() < len(clash) - 100


def test_knobs_do_not_hang_on_a_thread():
    room, c = standing()
    b = room.borders
    found = {tuple(pair) for pair in clashes(room, c).tolist()}
    foot = shapely.points(c.middle)
    tip = shapely.points(c.drawn(room.shapes.discs[c.shape][:, 2:, :2])[:, 0])
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
