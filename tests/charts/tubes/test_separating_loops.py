"""Loops around a tube divide it into rings."""

import numpy as np
import pytest

from meshjig.charts.tubes.ends import rims, two_ends
from meshjig.charts.tubes.separating_loops import across, divided
from meshjig.errors import ChartError
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges, compact, edges
from tests.charts.revolved import bent, cone, limb, pole, revolved, vase

TUBES = {
    "pole": pole(),
    "twisted": pole(turn=0.4),
    "cone": cone(),
    "bent": bent(pole(turn=0.3)),
    "vase": vase(),
    "limb": limb(),
}


@pytest.mark.parametrize("name", TUBES)
def test_the_line_crosses_every_loop_once(name):
    V, F = TUBES[name]
    left = across(V, F, two_ends(V, F))
    jump = (np.roll(left, -1, 1).astype(int) - left.astype(int)).ravel()
    e = edges(F)
    ends = two_ends(V, F)
    inner = ~np.isin(F, [end[0] for end in ends if len(end) == 1]).any(1)
    h = np.flatnonzero((e.twin != np.arange(len(e.twin))) & np.repeat(inner, 3))
    h = h[inner[e.twin[h] // 3]]
    np.testing.assert_array_equal(jump[h], -jump[e.twin[h]])  # both faces at an edge agree


@pytest.mark.parametrize("name", TUBES)
def test_parts_between_loops_are_rings_and_caps(name):
    V, F = TUBES[name]
    ends = two_ends(V, F)
    along = V[:, 1] if name != "bent" else 60 * np.arctan2(V[:, 1], V[:, 0])
    label = divided(V, F, ends, across(V, F, ends), along, np.array([30.0, 60.0]))
    assert set(label.tolist()) == {0, 1, 2}
    tips = [len(end) == 1 for end in ends]
    for k, n_rims in enumerate([2 - tips[0], 2, 2 - tips[1]]):
        G, kept = compact(F[label == k])
        assert components(G)[0] == 1
        assert len(rims(G)) == n_rims
        assert len(kept) - len(edges(G).E) + len(G) == 2 - n_rims
    middle = along[F].mean(1)
    for k, cut in enumerate((30.0, 60.0)):
        assert middle[label <= k].max() < cut + 6
        assert middle[label > k].min() > cut - 6


def test_loops_run_straight_where_the_edges_do():
    V, F = pole()
    ends = two_ends(V, F)
    label = divided(V, F, ends, across(V, F, ends), V[:, 1], np.array([44.0]))
    G = F[label == 0]
    h = border_halfedges(G)
    top = V[G.ravel()[h]][:, 1]
    assert len(np.unique(np.round(top[top > 10], 6))) == 1


def test_loops_with_no_room_are_refused():
    V, F = revolved(np.full(4, 20.0), np.linspace(0, 9, 4))
    ends = two_ends(V, F)
    with pytest.raises(ChartError):
        divided(V, F, ends, across(V, F, ends), V[:, 1], np.array([3.9, 4.1]))
