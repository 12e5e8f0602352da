"""Strips of triangles face one side."""

import numpy as np
import pytest

from meshjig.mesh.measure import area_vectors
from meshjig.scan.files.strips import strip_triangles

ZIGZAG = np.array([(k // 2, k % 2, 0) for k in range(8)], float)


@pytest.mark.parametrize(
    ("corners", "sizes", "count"),
    [
        ([0, 1, 2, 3, 4, 5], [6], 4),
        ([0, 1, 2, 3, 2, 3, 4, 5], [4, 4], 4),
        ([0, 1, 2, 3, -1, 2, 3, 4, -1], [9], 3),
        ([0, 1, 2, 2, 3, 4], [6], 2),  # turned once to go on elsewhere
        ([0, 1], [2], 0),
        ([], [], 0),
        ([-1, -1], [0, 2], 0),
    ],
)
def test_the_triangles_of_strips(corners, sizes, count):
    F = strip_triangles(np.array(corners, np.int64), np.array(sizes, np.int64))
    assert len(F) == count
    if count and corners != [0, 1, 2, 2, 3, 4]:
        assert len(np.unique(np.sign(area_vectors(ZIGZAG, F)[:, 2]))) == 1
