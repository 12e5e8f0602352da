import numpy as np
import pytest

from meshjig.charts import build_atlas, curve, lift
from meshjig.charts.lift import locate
from meshjig.mesh.types import Atlas, Mesh
from tests.charts.helpers import half_tube, unrolled_tube
from tests.meshes import disc, torus


@pytest.fixture(scope="module")
def atlas():
    return build_atlas(Mesh(*torus(1200)))


def flat_atlas(V, F, uv):
    return Atlas(Mesh(V, F), uv, F, np.zeros(len(F), np.int64))


def test_points_of_faces_come_back_to_where_they_were(atlas):
    rng = np.random.default_rng(0)
    for chart in range(atlas.n_charts):
        faces = rng.choice(np.flatnonzero(atlas.chart_of_face == chart), 100)
        bary = rng.dirichlet([1, 1, 1], 100)
        uv = np.einsum("kj,kjd->kd", bary, atlas.uv[atlas.F_uv[faces]])
        found, weights, xyz = lift(atlas, chart, uv)
        assert (found == faces).all()
        np.testing.assert_allclose(weights, bary, atol=1e-9)
        np.testing.assert_allclose(
            xyz, np.einsum("kj,kjd->kd", bary, atlas.mesh.V[atlas.mesh.F[faces]]), atol=1e-8
        )


def test_a_point_of_another_chart_is_not_found(atlas):
    other = atlas.uv[atlas.F_uv[atlas.chart_of_face == 1]].mean(1)
    face, bary, xyz = lift(atlas, 0, other)
    assert (face == -1).all()
    assert np.isnan(bary).all()
    assert np.isnan(xyz).all()


def test_a_straight_line_on_a_flat_chart_keeps_its_length():
    V, F = disc(2000)
    (line,) = curve(flat_atlas(V, F, V[:, :2].copy()), 0, np.array([[-30.0, -20], [31, 17]]))
    assert np.linalg.norm(np.diff(line, axis=0), axis=1).sum() == pytest.approx(np.hypot(61, 37), rel=1e-12)
    assert len(line) > 20


def test_a_closed_curve_on_a_rolled_sheet_keeps_its_length_and_bends_at_edges_only():
    n, radius, length = 24, 20.0, 60.0
    V, F = half_tube(n, radius, length)
    facet = 2 * radius * np.sin(np.pi / 2 / n)
    i, j = np.divmod(np.arange(len(V)), n + 1)
    uv = np.stack([i * facet, j * length / n], 1)
    angle = np.linspace(0, 2 * np.pi, 60)
    circle = np.array([30.0, 30]) + 17 * np.stack([np.cos(angle), np.sin(angle)], 1)
    (line,) = curve(flat_atlas(V, F, uv), 0, circle)
    expected = np.linalg.norm(np.diff(circle, axis=0), axis=1).sum()
    assert np.linalg.norm(np.diff(line, axis=0), axis=1).sum() == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(line[0], line[-1], atol=1e-9)
    middles = (line[1:] + line[:-1]) / 2  # each piece lies in a facet, not under it
    sector = np.pi / n
    off = np.mod(np.arctan2(middles[:, 1], middles[:, 0]), sector) - sector / 2
    np.testing.assert_allclose(
        np.hypot(middles[:, 0], middles[:, 1]) * np.cos(off), radius * np.cos(sector / 2), rtol=1e-9
    )


def test_a_curve_breaks_where_it_leaves_the_chart():
    V, F = disc(2000)
    ring = np.linalg.norm(V[F].mean(1), axis=1) > 20
    parts = curve(flat_atlas(V, F[ring], V[:, :2].copy()), 0, np.array([[-80.0, 0.5], [80, 0.5]]))
    assert [np.sign(part[:, 0].mean()) for part in parts] == [-1, 1]
    assert [np.ptp(part[:, 0]) for part in parts] == pytest.approx([30, 30], abs=3)


def test_a_line_along_edges_and_through_corners_is_whole():
    V, F = disc(600)
    (line,) = curve(flat_atlas(V, F, V[:, :2].copy()), 0, np.array([[-45.0, 0], [45, 0]]))
    np.testing.assert_allclose(np.linalg.norm(np.diff(line, axis=0), axis=1).sum(), 90, rtol=1e-12)


def test_nothing_in_nothing_out(atlas):
    assert curve(atlas, 0, np.empty((0, 2))) == []
    assert curve(atlas, 0, np.array([[1e6, 1e6], [1e6, 2e6]])) == []


def ring():
    """Unroll a tube of radius 25 mm and height 100 mm as a ring."""
    V, F, uv, G = unrolled_tube()
    return Atlas(Mesh(V, F), uv, G, np.zeros(len(F), np.int64), period=np.array([np.ptp(uv[:, 0])]))


def test_on_a_ring_points_whole_periods_apart_are_one():
    tube = ring()
    uv = np.random.default_rng(0).uniform([-70, -45], [70, 45], (50, 2))
    _, _, here = lift(tube, 0, uv)
    assert np.isfinite(here).all()
    for periods in (-2, -1, 1, 3):
        _, _, there = lift(tube, 0, uv + np.array([tube.period[0] * periods, 0]))
        np.testing.assert_allclose(there, here, atol=1e-5)


def test_a_line_twice_around_a_ring_is_one_curve_of_that_length():
    tube = ring()
    (around,) = curve(tube, 0, np.array([[-200.0, 10.0], [-200.0 + 2 * tube.period[0], 10.0]]))
    assert np.linalg.norm(np.diff(around, axis=0), axis=1).sum() == pytest.approx(4 * np.pi * 25, rel=0.01)
    np.testing.assert_allclose(around[0], around[-1], atol=1e-4)
    np.testing.assert_allclose(around[:, 2], 10, atol=1e-4)


def test_points_inside_get_the_face_that_holds_them_and_others_none():
    V, F = disc(2000)
    rng = np.random.default_rng(0)
    points = rng.uniform(-70, 70, (3000, 2))
    face, bary = locate(V[:, :2], F, points)
    radius = np.linalg.norm(points, axis=1)
    assert (face[radius < 49] >= 0).all()
    assert (face[radius > 50.001] == -1).all()
    assert np.isnan(bary[face < 0]).all()
    held = face >= 0
    assert bary[held].min() >= -1e-9
    np.testing.assert_allclose(
        np.einsum("kj,kjd->kd", bary[held], V[F[face[held]], :2]), points[held], atol=1e-9
    )


def test_every_corner_is_found_though_it_lies_in_several_faces():
    V, F = disc(500)
    face, bary = locate(V[:, :2], F, V[:, :2])
    assert (F[face] == np.arange(len(V))[:, None]).any(1).all()
    np.testing.assert_allclose(bary.max(1), 1, atol=1e-9)


def test_needles_and_nothing_are_no_trouble():
    uv = np.array([[0, 0], [1000, 1], [0, 1e-3], [0.0, 50]])
    F = np.array([[0, 1, 2], [2, 1, 3]])
    face, _ = locate(uv, F, np.array([[10, 0.0105], [10, 20.0], [np.nan, 0], [1e9, 1e9]]))
    assert face.tolist() == [0, 1, -1, -1]
    assert locate(uv, F[:0], uv)[0].tolist() == [-1] * 4
    assert locate(uv, F, uv[:0])[0].shape == (0,)
