"""Boxes that share space: the one that is put in first gives it up."""

import pytest

from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.mesh import Mesh
from meshjig.solid.no_overlaps import without_overlaps
from tests.check.pieces import box

CORNERS = ([0, 0, 0], [4, 4, 4]), ([3, 1, 1], [7, 3, 3]), ([9, 0, 0], [10, 1, 1])


def test_the_earlier_piece_gives_up_what_is_shared():
    boxes = [Mesh(*box(*ends)) for ends in CORNERS]
    made = without_overlaps(boxes)
    assert [mesh_volume(*solid) for solid in made] == pytest.approx([60, 16, 1])
    assert made[1] is boxes[1]
    assert made[2] is boxes[2]
