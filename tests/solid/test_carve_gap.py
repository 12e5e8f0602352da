"""A piece that crosses itself is mended where that can help, and not where it can't."""

import numpy as np
import pytest

from meshjig.check import is_closed
from meshjig.solid import kerf
from tests.meshes import sphere


def test_a_surface_that_is_folded_all_over_is_not_mended(monkeypatch):
    mesh = sphere(2000)
    V = mesh.V + np.random.default_rng(0).normal(0, 4.0, mesh.V.shape)
    halves = (mesh.V[mesh.F].mean(1)[:, 0] > 0).astype(np.int64)
    monkeypatch.setattr("meshjig.solid.carve_gap.repair", lambda solid, width: pytest.fail("it was tried"))
    solids, facts = kerf(V, mesh.F, halves, -2.0 * mesh.V / 50, 0.2)
    assert facts.crossing == [0, 1]
    assert all(is_closed(solid.F) for solid in solids)
