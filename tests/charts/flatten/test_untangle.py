import numpy as np
import pytest

from meshjig.charts.distortion import border_is_simple
from meshjig.charts.flatten import untangle
from meshjig.charts.flatten.untangle import faces_around, separate_border
from tests.charts.helpers import all_turn_left
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


def nearly_a_ring(overlap, n=120, rows=6):
    """Bend a flat strip so far that its two ends overlap."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n + 1), np.arange(rows + 1), indexing="ij"))
    angle, radius = (2 * np.pi + overlap) * i / n, 10 + 6 * j / rows
    uv = np.stack([radius * np.cos(-angle), radius * np.sin(-angle)], 1)
    a = (np.arange(n)[:, None] * (rows + 1) + np.arange(rows)[None]).ravel()
    F = np.concatenate([np.stack([a, a + rows + 1, a + rows + 2], 1), np.stack([a, a + rows + 2, a + 1], 1)])
    F = F.astype(np.int64)
    return uv, F if all_turn_left(uv, F) else F[:, ::-1].copy()


def test_ends_that_overlap_a_little_are_drawn_apart_and_the_rest_stays():
    uv, F = nearly_a_ring(0.02)
    V = np.column_stack([uv, np.linspace(0, 5, len(uv))])
    assert all_turn_left(uv, F)
    assert not border_is_simple(uv, F)
    clear = separate_border(V, F, uv)
    assert all_turn_left(clear, F)
    assert border_is_simple(clear, F)
    far = uv[:, 0] < 0
    assert (clear[far] == uv[far]).all()
