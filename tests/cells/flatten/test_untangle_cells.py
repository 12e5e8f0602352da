"""Small folds are undone, and nothing else moves."""

import numpy as np
import pytest

from meshjig.cells.flatten.planar import folded, mirrored, patches
from meshjig.cells.flatten.untangle_cells import unfolded
from meshjig.mesh.halfedges import border_halfedges
from tests.meshes import disc


@pytest.mark.parametrize("seed", range(5))
def test_vertices_that_were_pushed_over_their_neighbours_come_back(seed):
    V, F = disc(1500)
    p = patches(V, F, np.zeros(len(F), np.int64))
    uv = p.V[:, :2].copy()
    rng = np.random.default_rng(seed)
    inner = np.setdiff1d(np.arange(len(p.V)), p.F.ravel()[border_halfedges(p.F)])
    pushed = rng.choice(inner, 12, replace=False)
    uv[pushed] += rng.normal(scale=6.0, size=(12, 2))
    assert mirrored(p, uv).sum() > 10
    assert folded(p, uv).all()
    flat = unfolded(p, uv)
    assert not mirrored(p, flat).any()
    still = (flat == uv).all(1)
    assert still.sum() > 0.75 * len(uv)
    np.testing.assert_array_equal(np.isin(np.flatnonzero(~still), inner), True)


def test_a_fold_at_the_rim_is_left_rather_than_made_worse():
    V, F = disc(400)
    p = patches(V, F, np.zeros(len(F), np.int64))
    uv = p.V[:, :2].copy()
    rim = p.F.ravel()[border_halfedges(p.F)[0]]
    uv[rim] *= 0.2
    before = mirrored(p, uv).sum()
    assert before > 0
    assert mirrored(p, unfolded(p, uv)).sum() <= before
    np.testing.assert_array_equal(unfolded(p, uv)[rim], uv[rim])
