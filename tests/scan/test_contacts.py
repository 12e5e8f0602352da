"""Bodies that touch stand apart afterwards, by at least what was asked, and nothing else has moved."""

import numpy as np
import pytest

from meshjig.mesh.booleans import body
from meshjig.mesh.components import components
from meshjig.mesh.measure import mesh_volume
from meshjig.scan import repair
from meshjig.scan.contacts import draw_apart
from tests.meshes import sphere
from tests.scan.boxes import box, welded

APART = 0.02


@pytest.mark.parametrize("at", [(1, 0, 0), (1, 1, 0), (1, 1, 1)], ids=["wall", "edge", "corner"])
def test_boxes_that_touch_stand_apart(at):
    V, F, _ = repair(*welded(box(), box(at)))
    moved = draw_apart(V, F, APART)
    first, second = (body(moved.V, F[components(F)[1] == k]) for k in range(2))
    assert APART * (1 - 1e-9) <= first.min_gap(second, 1.0) <= 2 * APART
    still = np.linalg.norm(moved.V - V, axis=1) == 0
    assert moved.n_vertices == (~still).sum() == 2 * {1: 9, 2: 3, 3: 1}[sum(at)]
    assert np.linalg.norm(np.array(moved.at) - np.array(at) / 2) <= 0.75
    assert 2 - 1.01 * APART < mesh_volume(moved.V, F) < 2


def test_what_touches_nothing_stays():
    V, F = sphere(300)
    assert draw_apart(V, F, APART).n_vertices == 0
    V, F, _ = repair(*welded(box(), box((1, 0, 0))))
    assert np.array_equal(draw_apart(V, F, 0.0).V, V)
