import numpy as np
import pytest

from meshjig.charts.flatten import untangle
from meshjig.charts.flatten.untangle import faces_around
from tests.meshes import disc, torus


@pytest.mark.parametrize("is_large", [False, True])
@pytest.mark.parametrize(("mesh", "rings"), [(disc(3000), 0), (disc(3000), 4), (torus(2000), 3)])
def test_rings_of_faces_share_vertices_with_those_before(monkeypatch, is_large, mesh, rings):
    monkeypatch.setattr(untangle, "_LARGE", 0 if is_large else np.inf)
    F = mesh.F
    chosen = np.zeros(len(F), bool)
    chosen[[5, len(F) // 2]] = True
    expected = chosen
    for _ in range(rings):
        expected = np.isin(F, F[expected]).any(1)
    assert not expected.all()
    assert (faces_around(F, chosen, rings) == expected).all()
