"""Points in one place, and near each other, are linked; others are not."""

import numpy as np
import pytest

from meshjig.mesh.arrays import connected
from meshjig.scan.close_points import close_pairs

GRID = np.stack(np.meshgrid(*[np.arange(6.0)] * 3), -1).reshape(-1, 3)  # every coordinate is shared by many


@pytest.mark.parametrize("points", [GRID, np.random.default_rng(0).random((500, 3))])
def test_who_is_linked_is_what_all_distances_say(points):
    rng = np.random.default_rng(1)
    near = points[rng.integers(0, len(points), 60)] + rng.uniform(-2e-3, 2e-3, (60, 3))
    P = rng.permutation(np.concatenate([points, near, points[:50], -0.0 * points[:1]]))
    pairs = close_pairs(P, 1e-3)
    n, label = connected(len(P), *pairs.T)
    far = np.linalg.norm(P[:, None] - P[None], axis=2) > 1e-3
    a, b = np.nonzero(~far)
    right, expected = connected(len(P), a, b)
    assert n == right
    np.testing.assert_array_equal(label, expected)


def test_points_that_share_two_coordinates_only_are_not_linked():
    assert not len(close_pairs(GRID, 1e-3))
