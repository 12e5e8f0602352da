"""Tiles that are given edge by edge become a unit, whichever of them name an edge; misfits are named."""

import numpy as np
import pytest

from meshjig.tiling.assemble_unit import NoOtherSide, assemble
from meshjig.tiling.check_unit import check_unit

SQUARE = np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)])
SIDES = [np.array([a, b]) for a, b in zip(SQUARE, np.roll(SQUARE, -1, 0), strict=True)]


def test_a_square_has_two_edges_one_corner_and_area_1():
    unit = assemble([SIDES], 3 * np.eye(2))
    check_unit(unit)
    assert (len(unit.ends), len(unit.corners), unit.n_tiles) == (2, 1, 1)
    np.testing.assert_allclose(unit.translations, np.eye(2))


def test_two_tiles_share_the_edge_between_them():
    beside = [side + np.array([3.0, 0.0]) for side in SIDES]
    unit = assemble([SIDES, beside], np.diag([6.0, 3.0]))
    check_unit(unit)
    assert (len(unit.ends), len(unit.corners), unit.n_tiles) == (4, 2, 2)


def test_corners_within_the_tolerance_are_one():
    off = [side + np.array([[0.0, 0.0], [0.01, 0.0]]) for side in SIDES]
    check_unit(assemble([off], 3 * np.eye(2), tolerance=0.02))


def test_an_edge_without_its_other_side_is_named_by_its_middle():
    bent = [np.array([(0.0, 0.0), (1.5, 0.6), (3.0, 0.0)]), *SIDES[1:]]
    with pytest.raises(NoOtherSide, match="is no edge of the tile on its other side") as caught:
        assemble([bent], 3 * np.eye(2))
    np.testing.assert_allclose(caught.value.at, [1.5, 0.6])
