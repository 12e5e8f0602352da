"""The macro tile is one tile turned four ways, and no two of the four look alike unturned."""

from itertools import combinations

import numpy as np
import shapely

from meshjig.tiling.families.macro import leaning, macro
from tests.tiling.tilings import is_moved, outlines


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
