"""What is advised to lock a puzzle does lock it."""

import numpy as np
import pytest

from meshjig.cells import cell_atlas, grow_cells, knob_outlines
from meshjig.layout.lock_advice import lock_advice
from meshjig.mesh.types import Mesh
from tests.meshes import sphere

LEAST = 2.2  # mm, a neck


@pytest.fixture(scope="module")
def small_cells():
    mesh = Mesh(*sphere(2000, 10.0))
    return cell_atlas(grow_cells(mesh, 30)), float(np.sqrt(mesh.areas.sum() / 30))


def locked(made):
    return made.length[made.knob_of_border >= 0].sum() / made.length.sum()


def test_larger_cells_have_room(small_cells):
    atlas, size = small_cells
    advice = lock_advice(atlas, size=size, knob_size=1.0, least_neck=LEAST, seed=0)
    assert locked(knob_outlines(atlas, size=size, min_neck=LEAST)) < 0.1
    assert 1.0 < advice.larger < 2.5
    k = advice.larger
    grown = Mesh(*sphere(2000, 10.0 * k))
    larger = cell_atlas(grow_cells(grown, 30))
    assert locked(knob_outlines(larger, size=k * size, min_neck=LEAST)) > 0.6


def test_nothing_is_advised_where_no_neck_is_narrow_enough(small_cells):
    atlas, size = small_cells
    advice = lock_advice(atlas, size=size, knob_size=1.0, least_neck=100.0, seed=0)
    assert advice.larger is None
    assert advice.knob_size is None
