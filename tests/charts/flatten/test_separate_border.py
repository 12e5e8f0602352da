import numpy as np

from meshjig.charts.flatten.flatten import border_is_simple
from meshjig.charts.flatten.separate_border import part
from tests.charts.helpers import all_turn_left


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
    clear = part(V, F, uv)
    assert all_turn_left(clear, F)
    assert border_is_simple(clear, F)
    far = uv[:, 0] < 0
    assert (clear[far] == uv[far]).all()
