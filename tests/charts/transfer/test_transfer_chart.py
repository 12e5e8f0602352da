import igl
import numpy as np
import pytest

from meshjig.charts.chart import Chart, uncut_chart
from meshjig.charts.cuts import cut_open
from meshjig.charts.transfer.transfer_chart import ChartTransfer, without_outliers
from meshjig.charts.transfer.transfer_charts import _transferred
from meshjig.mesh.components import is_disc
from meshjig.mesh.halfedges import compact, edges
from meshjig.mesh.mesh import Mesh
from tests.charts.helpers import all_turn_left
from tests.meshes import cylinder, disc, half_sphere, noisy


def quarters_of_a_tube(V, F):
    x, y = V[F].mean(1)[:, :2].T
    return ((x > 0.01) * 2 + (y > 0.01)).astype(np.int64)


def unrolled_tube(V, F):
    """Cut the tube open between its quarters 0 and 1, and unroll it."""
    label = quarters_of_a_tube(V, F)
    e = edges(F)
    h = np.arange(3 * len(F))
    sides = np.sort(np.stack([label[h // 3], label[e.twin // 3]], 1), axis=1)
    cut = np.zeros(len(e.E), bool)
    cut[e.edge_of_halfedge[(sides == [0, 1]).all(1)]] = True
    corners, origin = cut_open(F, e, cut)
    centre = V[F].mean(1)
    turn = np.arctan2(V[F][..., 1], V[F][..., 0])
    # beside the cut, at half a turn, corners follow the side that their face is on
    turn = np.where(turn - np.arctan2(centre[:, 1], centre[:, 0])[:, None] > np.pi, turn - 2 * np.pi, turn)
    turn = np.where(np.arctan2(centre[:, 1], centre[:, 0])[:, None] - turn > np.pi, turn + 2 * np.pi, turn)
    uv = np.empty((len(origin), 2))
    uv[corners] = np.stack([25 * turn, V[F][..., 2]], -1)
    return label, Chart(np.arange(len(F)), uv, corners)


def finer(V, F):
    """Split every face in four; the new vertices lie on the old edges."""
    W, G = igl.upsample(V, F)
    return W, np.ascontiguousarray(G, np.int64)


@pytest.mark.parametrize("noise", [0.0, 0.15])
def test_a_cut_inside_a_chart_stays_and_the_rest_is_whole(noise):
    W, G = cylinder(1000)
    label, given = unrolled_tube(W, G)
    V, F = finer(W, G)
    V, F = noisy(type(cylinder(8))(V, F), noise)
    chart = ChartTransfer(Mesh(V, F), quarters_of_a_tube(V, F), Mesh(W, G), label).apply(given)
    assert chart is not None
    assert is_disc(chart.corners)
    assert all_turn_left(chart.uv, chart.corners)
    assert (chart.faces == np.arange(len(F))).all()
    tall, wide = np.sort(np.ptp(chart.uv, axis=0))
    assert (tall, wide) == pytest.approx((100, 50 * np.pi), rel=0.05)
    e = edges(chart.corners)
    rim = (e.n_faces == 1).sum() - (edges(F).n_faces == 1).sum()
    height = np.ptp(W[:, 2]) / len(np.unique(np.round(W[:, 2], 6)) + 1)
    assert rim / 2 == pytest.approx(2 * 100 / height, rel=0.3)


def test_on_the_proxy_itself_nothing_moves():
    W, G = cylinder(1000)
    label, given = unrolled_tube(W, G)
    chart = ChartTransfer(Mesh(W, G), label, Mesh(W, G), label).apply(given)
    place = chart.uv[chart.corners] - given.uv[given.corners]
    np.testing.assert_allclose(place - place[0, 0], 0, atol=0.2)


def test_a_region_that_is_no_disc_is_refused():
    W, G = cylinder(1000)
    label = quarters_of_a_tube(W, G)
    faces = np.flatnonzero(label == 0)
    given = uncut_chart(G, faces, W[compact(G[faces])[1]][:, 1:])
    scattered = np.where(np.arange(len(G)) % 7 == 0, 0, 1)
    assert ChartTransfer(Mesh(W, G), scattered, Mesh(W, G), np.minimum(label, 1)).apply(given) is None


def test_a_chart_without_the_leaf_that_can_not_be_carried_is_carried_in_parts():
    V, F = cylinder(1000)
    label, tube = unrolled_tube(V, F)

    class Refuses2(ChartTransfer):
        def apply(self, chart):
            return None if (label[chart.faces] == 2).any() else chart

    transfer = Refuses2(Mesh(V, F), label, Mesh(V, F), label)
    made, missing = _transferred(transfer, tube, label)
    assert [np.unique(label[part.faces]).tolist() for part in missing] == [[2]]
    # 2 and 3 lie opposite 0 and 1, which are cut apart; 0, without 2, hangs on nothing any more
    assert sorted(np.unique(label[chart.faces]).tolist() for chart in made) == [[0], [1, 3]]


def test_a_chart_whose_leaves_can_all_be_carried_but_not_together_falls_into_them():
    V, F = cylinder(1000)
    label, tube = unrolled_tube(V, F)

    class RefusesAll(ChartTransfer):
        def apply(self, chart):
            return chart if len(np.unique(label[chart.faces])) == 1 else None

    made, missing = _transferred(RefusesAll(Mesh(V, F), label, Mesh(V, F), label), tube, label)
    assert missing == []
    assert sorted(label[chart.faces[0]] for chart in made) == [0, 1, 2, 3]


def test_a_leaf_that_no_face_of_the_mesh_is_nearest_to_makes_no_chart():
    W, G = cylinder(1000)
    label = quarters_of_a_tube(W, G)
    faces = np.flatnonzero(label == 3)
    given = uncut_chart(G, faces, W[compact(G[faces])[1]][:, 1:])
    assert ChartTransfer(Mesh(W, G), np.minimum(label, 2), Mesh(W, G), label).apply(given) is None


@pytest.mark.parametrize("mesh", [disc(1500), half_sphere(1500), noisy(disc(1500), 0.3)])
def test_strays_come_back_and_all_others_stay(mesh):
    V, F = mesh
    flat = V[:, :2].copy()
    near = np.linalg.norm(V - V[200], axis=1) < 6
    thrown = flat.copy()
    thrown[near] += [60.0, 15.0]
    back = without_outliers(V, F, thrown)
    assert near.sum() >= 5
    np.testing.assert_array_equal(back[~near], flat[~near])
    assert np.linalg.norm(back[near] - flat[near], axis=1).max() < 6


def test_nothing_astray_is_nothing_changed():
    V, F = noisy(disc(1500), 0.3)
    np.testing.assert_array_equal(without_outliers(V, F, V[:, :2]), V[:, :2])
