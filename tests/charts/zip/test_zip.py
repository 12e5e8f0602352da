import numpy as np
import pytest

from meshjig.charts.chart import lie_along, uncut_chart
from meshjig.charts.distortion import border_is_simple, flat_share
from meshjig.charts.flatten.flatten import flatten
from meshjig.charts.segment.dual_graph import dual_graph, patches
from meshjig.charts.segment.split import split
from meshjig.charts.zip.zip import zip_charts
from meshjig.mesh.components import is_disc
from meshjig.mesh.halfedges import compact, edges
from meshjig.mesh.measure import face_areas
from meshjig.mesh.mesh import Mesh
from tests.charts.helpers import all_turn_left
from tests.meshes import closed_cylinder, cylinder, genus2, sphere, torus


def patchwork(V, F):
    return split(Mesh(V, F), patches(dual_graph(V, F), 16), lambda faces: is_disc(F[faces]), 0)


def charts_of(V, F, label):
    found = []
    for k in range(label.max() + 1):
        faces = np.flatnonzero(label == k)
        G, kept = compact(F[faces])
        found.append(uncut_chart(F, faces, flatten(V[kept], G)))
    return found


def share_within(V, F, chart):
    X = np.empty((len(chart.uv), 3))
    X[chart.corners] = V[F[chart.faces]]
    return flat_share(X, chart.corners, chart.uv)


def length_of_cuts(V, F, charts):
    place = np.empty((len(F), 3, 2))
    for number, chart in enumerate(charts):
        place[chart.faces] = chart.uv[chart.corners] + 1e4 * number
    twin, h = edges(F).twin, np.arange(3 * len(F))
    ahead = np.roll(place, -1, 1).reshape(-1, 2)
    cut = (twin > h) & (place.reshape(-1, 2) != ahead[twin]).any(1)
    ends = np.roll(F, -1, 1).ravel(), F.ravel()
    return np.linalg.norm(V[ends[0][cut]] - V[ends[1][cut]], axis=1).sum()


@pytest.mark.parametrize("maker", [sphere, torus, genus2, closed_cylinder])
def test_fewer_charts_and_shorter_seams_that_are_as_good(maker):
    V, F = maker(1500)
    before = charts_of(V, F, patchwork(V, F))
    after = zip_charts(V, F, before)
    assert len(after) <= 2 / 3 * len(before)
    assert length_of_cuts(V, F, after) < length_of_cuts(V, F, before)
    assert (np.sort(np.concatenate([chart.faces for chart in after])) == np.arange(len(F))).all()
    share = {id(chart): share_within(V, F, chart) for chart in before + after}
    for chart in after:
        parts = [part for part in before if np.isin(part.faces, chart.faces).all()]
        assert sum(len(part.faces) for part in parts) == len(chart.faces)
        area = [face_areas(V, F[part.faces]).sum() for part in parts]
        mean = np.average([share[id(part)] for part in parts], weights=area)
        assert share[id(chart)] >= min(0.985, mean - 0.005)
        assert is_disc(chart.corners)
        assert all_turn_left(chart.uv, chart.corners)
        assert border_is_simple(chart.uv, chart.corners)


def test_two_halves_of_a_tube_are_glued_along_one_line_and_stay_cut_along_the_other():
    V, F = cylinder(1600)
    halves = (V[F].mean(1)[:, 1] > 0.05).astype(np.int64)
    (tube,) = zip_charts(V, F, charts_of(V, F, halves))
    cut = length_of_cuts(V, F, [tube])
    assert 99.9 < cut < 115  # the tube is 100 mm long; the line may be a little crooked
    assert np.ptp(lie_along(tube.uv), axis=0) == pytest.approx((50 * np.pi, 100), rel=0.1)


def test_no_effort_leaves_all_as_it_is():
    V, F = sphere(1000)
    before = charts_of(V, F, patchwork(V, F))
    assert len(zip_charts(V, F, before, effort=0)) == len(before)


def test_a_lower_share_glues_more():
    V, F = sphere(1200)
    before = charts_of(V, F, patchwork(V, F))
    strict, lax = (zip_charts(V, F, before, least_shares=(share,)) for share in (0.999, 0.9))
    assert len(lax) <= len(strict)
    assert len(lax) == 1
    assert len(zip_charts(V, F, before, least_shares=(0.999, 0.9))) == 1
