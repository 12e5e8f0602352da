"""Hexagons are regular: six equal edges, three tiles at a corner."""

import numpy as np
import pytest

from meshjig.tiling.families.hexagon import hexagons
from meshjig.tiling.outline import edge_ends, tile_steps


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
