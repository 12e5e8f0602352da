"""Rings and caps cover tubes, fit a period away exactly, and keep within the stretch limits."""

import numpy as np
import pytest

from meshjig.charts.tubes.cut_annulus import annulus_of, cut_annulus, meets_itself
from meshjig.charts.tubes.periodic import is_tubular, periodic
from meshjig.errors import ChartError
from meshjig.mesh.components import is_disc
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.mesh.mesh import Mesh
from tests.charts.helpers import all_turn_left
from tests.charts.revolved import annulus, bent, cone, holed, limb, pole, vase
from tests.meshes import genus2, half_sphere, noisy, open_cup, saddle, sphere

STEP, PERIOD_STEP = 2.0**-18, 2.0**-8


def finer(mesh, times):
    """Split every face into four, so that the charts come by way of a proxy."""
    import trimesh

    V, F = mesh
    for _ in range(times):
        V, F = trimesh.remesh.subdivide(V, F)
    return np.asarray(V), np.asarray(F, np.int64)


TUBES = {
    "pole": pole(turn=0.4),
    "cone": cone(),
    "elbow": bent(pole(), 120.0),
    "vase": vase(),
    "limb": limb(),
    "holed": holed(vase(), vase()[0][30 * 60], 5.0),
    "fine vase": finer(vase(), 1),
    "fine limb": finer(limb(), 1),
    "noisy": noisy(type(sphere(20))(*finer(vase(), 1)), 0.1),
}


@pytest.fixture(scope="module", params=TUBES)
def charted(request):
    V, F = TUBES[request.param]
    return request.param, V, F, periodic(Mesh(V, F))


def test_charts_cover_every_face_once_and_mirror_none(charted):
    _, _, F, charts = charted
    np.testing.assert_array_equal(np.sort(np.concatenate([c.faces for c in charts])), np.arange(len(F)))
    for chart in charts:
        assert all_turn_left(chart.uv, chart.corners)
        assert len(np.unique(chart.corners)) == len(chart.uv)


def test_rings_are_strips_whose_sides_are_a_period_apart_exactly(charted):
    name, _, F, charts = charted
    rings = [chart for chart in charts if chart.period]
    assert rings
    for chart in rings:
        assert chart.period % PERIOD_STEP == 0
        np.testing.assert_array_equal(chart.uv % STEP, 0)
        rows, place = np.unique(chart.corners, return_index=True)
        vertex = F[chart.faces].ravel()[place]
        order = np.argsort(vertex, kind="stable")
        twice = np.flatnonzero(vertex[order][1:] == vertex[order][:-1])
        first, second = rows[order][twice], rows[order][twice + 1]
        assert len(twice) > 3
        np.testing.assert_array_equal(chart.uv[second] - chart.uv[first], [[chart.period, 0.0]] * len(twice))
        if name != "holed":
            assert is_disc(chart.corners)


def test_rings_do_not_meet_their_copies(charted):
    _, _, F, charts = charted
    for chart in charts:
        if chart.period:
            G, kept = compact(F[chart.faces])
            annulus = annulus_of(G)
            assert not meets_itself(
                annulus, cut_annulus(annulus, chart.uv[: len(kept)], chart.period), chart.period
            )


def test_the_stretch_is_within_limits_and_1_on_average(charted):
    name, V, F, charts = charted
    if name == "noisy":  # its faces are rough, its tiles are not
        return
    good = 0.0
    for chart in charts:
        area = face_areas(V, F[chart.faces])
        stretch = singular_values(V, F[chart.faces], chart.uv, chart.corners)
        good += area[(stretch[:, 1] >= 0.8) & (stretch[:, 0] <= 1.25)].sum()
        assert np.average(np.log(stretch).sum(1), weights=area) == pytest.approx(0, abs=0.04)
    assert good >= 0.965 * face_areas(V, F).sum()


@pytest.mark.parametrize(
    ("name", "rings", "caps"),
    [
        ("pole", 1, 0),
        ("elbow", 1, 0),
        ("cone", 3, 0),
        ("vase", 3, 1),
        ("limb", 1, 2),
        ("fine vase", 3, 1),
        ("fine limb", 1, 2),
    ],
)
def test_charts_are_as_few_as_the_girths_allow(name, rings, caps):
    charts = periodic(Mesh(*TUBES[name]))
    assert [sum(bool(c.period) for c in charts), sum(not c.period for c in charts)] == [rings, caps]


def test_the_period_of_a_pole_is_its_girth():
    (chart,) = periodic(Mesh(*pole()))
    assert chart.period == pytest.approx(60 * 2 * 15 * np.sin(np.pi / 60), rel=2e-3)
    assert np.ptp(chart.uv[:, 1]) == pytest.approx(90, rel=2e-3)


def test_the_same_tube_gives_the_same_charts():
    V, F = TUBES["fine limb"]
    for one, other in zip(periodic(Mesh(V, F)), periodic(Mesh(V, F)), strict=True):
        np.testing.assert_array_equal(one.faces, other.faces)
        np.testing.assert_array_equal(one.uv, other.uv)


@pytest.mark.parametrize(
    ("mesh", "words"),
    [
        (genus2(2000), "handles"),
        (saddle(1500), "tube|bulges"),
        (annulus(), "tube|bulges"),
        (holed(vase(), np.array([0.0, 0, 0]), 4.0), "hole near .* --fill-holes"),
    ],
    ids=["genus2", "saddle", "annulus", "drained"],
)
def test_what_is_no_tube_is_refused_in_a_sentence(mesh, words):
    with pytest.raises(ChartError, match=words):
        periodic(Mesh(*mesh))


def test_vases_and_limbs_suit():
    for name in ("pole", "vase", "limb", "fine vase", "elbow"):
        assert is_tubular(Mesh(*TUBES[name])), name


@pytest.mark.parametrize("mesh", [sphere(2000), genus2(2000), half_sphere(1500), open_cup(1500), annulus()])
def test_other_shapes_do_not(mesh):
    assert not is_tubular(Mesh(*mesh))
