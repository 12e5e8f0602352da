"""Loops around a tube divide it into rings."""

import numpy as np
import pytest

from meshjig.charts.tubes.harmonic_function import two_ends
from meshjig.charts.tubes.separating_loops import across, divided, halfedges_along, left_corners
from meshjig.errors import ChartError
from meshjig.mesh.boundary_loops import borders_by_length
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges, compact, edges
from meshjig.mesh.mesh import Mesh
from tests.charts.helpers import half_tube
from tests.charts.revolved import bent, cone, limb, pole, revolved, vase
from tests.meshes import disc

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
    left = across(V, F, two_ends(Mesh(V, F)))
    jump = (np.roll(left, -1, 1).astype(int) - left.astype(int)).ravel()
    e = edges(F)
    ends = two_ends(Mesh(V, F))
    inner = ~np.isin(F, [end[0] for end in ends if len(end) == 1]).any(1)
    h = np.flatnonzero((e.twin != np.arange(len(e.twin))) & np.repeat(inner, 3))
    h = h[inner[e.twin[h] // 3]]
    np.testing.assert_array_equal(jump[h], -jump[e.twin[h]])  # both faces at an edge agree


@pytest.mark.parametrize("name", TUBES)
def test_parts_between_loops_are_rings_and_caps(name):
    V, F = TUBES[name]
    ends = two_ends(Mesh(V, F))
    along = V[:, 1] if name != "bent" else 60 * np.arctan2(V[:, 1], V[:, 0])
    label = divided(V, F, ends, across(V, F, ends), along, np.array([30.0, 60.0]))
    assert set(label.tolist()) == {0, 1, 2}
    tips = [len(end) == 1 for end in ends]
    for k, n_rims in enumerate([2 - tips[0], 2, 2 - tips[1]]):
        G, kept = compact(F[label == k])
        assert components(G)[0] == 1
        assert len(borders_by_length(G)) == n_rims
        assert len(kept) - len(edges(G).E) + len(G) == 2 - n_rims
    middle = along[F].mean(1)
    for k, cut in enumerate((30.0, 60.0)):
        assert middle[label <= k].max() < cut + 6
        assert middle[label > k].min() > cut - 6


def test_loops_run_straight_where_the_edges_do():
    V, F = pole()
    ends = two_ends(Mesh(V, F))
    label = divided(V, F, ends, across(V, F, ends), V[:, 1], np.array([44.0]))
    G = F[label == 0]
    h = border_halfedges(G)
    top = V[G.ravel()[h]][:, 1]
    assert len(np.unique(np.round(top[top > 10], 6))) == 1


def test_loops_with_no_room_are_refused():
    V, F = revolved(np.full(4, 20.0), np.linspace(0, 9, 4))
    ends = two_ends(Mesh(V, F))
    with pytest.raises(ChartError):
        divided(V, F, ends, across(V, F, ends), V[:, 1], np.array([3.9, 4.1]))


def test_left_of_a_line_up_a_tube_is_on_its_left():
    V, F = pole()
    way = np.arange(40) * 60 + 7  # up the tube
    left = left_corners(F, way)
    assert set(F[left].tolist()) == set(way.tolist())
    angle = np.arctan2(-V[F].mean(1)[:, 2], V[F].mean(1)[:, 0]) - 2 * np.pi * 7 / 60
    np.testing.assert_array_equal(
        left.any(1) & (angle > 0), False
    )  # seen from outside, angles grow to the right
    touching = np.isin(F, way).any(1)
    np.testing.assert_array_equal(left.any(1)[touching], angle[touching] < 0)


@pytest.mark.parametrize("back", [False, True])
def test_both_sides_together_are_all_corners_on_the_way(back):
    _, F = pole(turn=0.5)
    way = np.array([r * 60 + 30 for r in range(40)])
    way = way[::-1] if back else way
    other = left_corners(F, way[::-1].copy())
    left = left_corners(F, way)
    np.testing.assert_array_equal(left | other, np.isin(F, way))
    assert not (left & other).any()


def test_an_end_inside_has_nothing_on_its_left():
    n = 24
    _, F = half_tube(n)
    inside = np.array([(n + 1) * k + n // 2 for k in range(n // 2)])  # from the border to the middle
    left = left_corners(F, inside)
    assert inside[0] in F[left]
    assert inside[-1] not in F[left]


def test_halfedges_along_a_way_come_from_both_sides():
    _, F = disc(600)
    a, b, _ = F[40]
    h = halfedges_along(F, np.array([a, b]))
    assert len(h) == 2
    assert {tuple(sorted((F.ravel()[x], np.roll(F, -1, 1).ravel()[x]))) for x in h} == {tuple(sorted((a, b)))}
