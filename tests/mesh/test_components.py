"""Which faces are connected, at edges and around vertices."""

import numpy as np
import pytest

from meshjig.mesh.components import components, fans, is_disc, label_components
from meshjig.mesh.halfedges import edges
from tests.meshes import disc, half_sphere, joined, moved, sphere, torus


def test_bodies_are_components_and_walls_part_them():
    F = joined(sphere(300), moved(torus(300), [200, 0, 0])).F
    n, label = components(F)
    assert n == 2
    assert np.bincount(label).tolist() == [int((label == 0).sum()), int((label == 1).sum())]
    n, label = components(F, wall=np.ones(3 * len(F), bool))
    assert (n, label.tolist()) == (len(F), list(range(len(F))))


def test_a_vertex_where_two_fans_meet_is_split():
    """Two triangles that share one corner only."""
    F, origin = fans(np.array([[0, 1, 2], [0, 3, 4]]))
    assert len(origin) == 6
    assert np.bincount(origin).tolist() == [2, 1, 1, 1, 1]
    assert origin[F].tolist() == [[0, 1, 2], [0, 3, 4]]
    whole, of = fans(sphere(100).F)
    np.testing.assert_array_equal(of[whole], sphere(100).F)


@pytest.mark.parametrize(
    ("F", "disc"),
    [
        (half_sphere(200).F, True),
        (sphere(200).F, False),
        (torus(200).F, False),
        (np.array([[0, 1, 2], [0, 3, 4]]), False),  # joined at a vertex only
        (np.array([[0, 1, 2], [3, 4, 5]]), False),
        (np.zeros((0, 3), int), False),
    ],
)
def test_a_disc_is_told(F, disc):
    assert is_disc(F) is disc


def test_parts_of_labels_are_the_components_between_walls():
    V, F = disc(600)
    label = (V[F].mean(1)[:, 0] ** 2 > 400).astype(np.int64)  # left and right are alike, the middle is not
    twin = edges(F).twin
    beside = np.where(twin == np.arange(len(twin)), -1, twin // 3).reshape(-1, 3)
    n, part = label_components(label, beside)
    sides = np.repeat(label, 3)
    m, expected = components(F, sides != sides[twin])
    assert n == m == 3
    assert len(np.unique(part * 3 + expected)) == 3
