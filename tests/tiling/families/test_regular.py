"""Hexagons are regular; the macro tile is one tile turned four ways, no two of the four alike unturned."""

from itertools import combinations

import numpy as np
import pytest
import shapely

from meshjig.tiling.families.regular import hexagons, macro
from meshjig.tiling.template import leaning
from meshjig.tiling.unit import edge_ends, tile_steps
from tests.tiling.tilings import is_moved, outlines


def test_hexagon_is_regular():
    unit = hexagons()
    (steps,) = tile_steps(unit)
    ends = edge_ends(unit)
    corners = np.array(
        [
            ends[step.edge, 0 if step.forward else 1] + np.array(step.shift) @ unit.translations
            for step in steps
        ]
    )
    assert len(corners) == 6
    assert np.linalg.norm(corners, axis=1) == pytest.approx(np.sqrt(2 / np.sqrt(27)))
    assert np.linalg.norm(np.roll(corners, -1, 0) - corners, axis=1) == pytest.approx(
        np.sqrt(2 / np.sqrt(27))
    )


def test_three_edges_meet_at_every_corner():
    assert (np.bincount(hexagons().ends[..., 0].ravel()) == 3).all()


def test_four_tiles_are_one_turned():
    first, *others = outlines(macro())
    assert all(is_moved(first, other) for other in others)


def test_no_tile_is_another_only_moved():
    rings = [shapely.LinearRing(tile - np.floor(tile.mean(0))) for tile in outlines(macro())]
    assert all(a.hausdorff_distance(b) > 0.1 for a, b in combinations(rings, 2))


def test_knob_leans_and_its_head_is_wider_than_its_neck():
    template = leaning(20)
    x = template.points[:, 0]
    assert np.ptp(x[list(template.head)]) > 1.6 * template.neck_width
    assert x[np.argmax(template.points[:, 1])] > x[list(template.neck)].mean() + 0.03
