import numpy as np
import pytest

from meshjig.charts import build_atlas, lift, trimming_curves
from meshjig.charts.cuts import cut_faces, cut_open
from meshjig.mesh.components import components, fans
from meshjig.mesh.halfedges import edges
from meshjig.mesh.types import Atlas, Mesh
from tests.meshes import cylinder, disc, sphere, torus


@pytest.mark.parametrize(("mesh", "n_parts"), [(torus(800), 1), (cylinder(400), 2), (disc(600), 2)])
def test_cutting_a_plane_through_parts_what_it_separates(mesh, n_parts):
    V, F = mesh
    e = edges(F)
    front = V[F].mean(1)[:, 1] > 0.1
    h = np.arange(3 * len(F))
    cut = np.zeros(len(e.E), bool)
    cut[e.edge_of_halfedge[h[front[h // 3] & ~front[e.twin // 3]]]] = True
    if n_parts == 1:  # only one of the two circles around the tube
        cut &= V[e.E[:, 0], 0] > 0
    corners, origin = cut_open(F, e, cut)
    assert (origin[corners] == F).all()
    assert components(corners)[0] == n_parts
    assert (edges(corners).n_faces == 1).sum() == (e.n_faces == 1).sum() + 2 * cut.sum()


def test_nothing_cut_is_nothing_changed():
    _, F = torus(800)
    e = edges(F)
    corners, origin = cut_open(F, e, np.zeros(len(e.E), bool))
    assert len(origin) == F.max() + 1
    assert (origin[corners] == F).all()


def test_faces_that_only_touch_at_a_point_have_corners_of_their_own():
    F = np.array([[0, 1, 2], [0, 3, 4]])
    e = edges(F)
    corners = cut_faces(F, e, np.zeros(len(e.E), bool), np.arange(2))
    assert len(np.unique(corners)) == 6


@pytest.mark.parametrize("mesh", [sphere(800), torus(800), cylinder(600)])
def test_mates_describe_the_same_points_of_space(mesh):
    atlas = build_atlas(Mesh(*mesh))
    for c in trimming_curves(atlas):
        sides = [(c.chart, c.uv)] + ([(c.mate, c.mate_uv)] if c.mate >= 0 else [])
        for chart, uv in sides:
            assert len(uv) == len(c.xyz)
            _, _, xyz = lift(atlas, chart, uv)
            found = ~np.isnan(xyz[:, 0])  # rounding may put a corner of the rim outside
            assert found.mean() > 0.5
            np.testing.assert_allclose(xyz[found], c.xyz[found], atol=1e-5)


@pytest.mark.parametrize("mesh", [sphere(800), torus(800), cylinder(600)])
def test_every_border_is_covered_once_from_each_side(mesh):
    atlas = build_atlas(Mesh(*mesh))
    curves = trimming_curves(atlas)
    length = lambda c: np.linalg.norm(np.diff(c.xyz, axis=0), axis=1).sum()  # noqa: E731
    e = edges(mesh.F)
    G, ahead = atlas.F_uv.ravel(), np.roll(atlas.F_uv, -1, 1).ravel()
    seam = (e.twin != np.arange(len(e.twin))) & ((ahead[e.twin] != G) | (ahead != G[e.twin]))
    a, b = mesh.F.ravel(), np.roll(mesh.F, -1, 1).ravel()
    long = np.linalg.norm(mesh.V[a] - mesh.V[b], axis=1)
    assert sum(length(c) for c in curves if c.mate >= 0) == pytest.approx(long[seam].sum())
    border = e.twin == np.arange(len(e.twin))
    assert sum(length(c) for c in curves if c.mate < 0) == pytest.approx(long[border].sum())
    one_way = {
        (c.chart, c.mate, c.xyz.tobytes()) for c in curves if c.mate >= 0 and (c.xyz[0] != c.xyz[-1]).any()
    }
    assert {(m, c, np.frombuffer(x).reshape(-1, 3)[::-1].tobytes()) for c, m, x in one_way} == one_way


def test_a_chart_lies_on_the_left_and_a_plain_border_closes():
    V, F = disc(600)
    (c,) = trimming_curves(Atlas(Mesh(V, F), V[:, :2].copy(), F, np.zeros(len(F), np.int64)))
    assert (c.chart, c.mate, c.mate_uv.shape) == (0, -1, (0, 2))
    assert (c.uv[0] == c.uv[-1]).all()
    x, y = c.uv.T
    assert (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() > 0


def test_a_slit_is_its_own_mate():
    V, F = disc(600)
    side = V[F].mean(1)[:, 1] > 0
    G = F.copy()
    on_slit = (np.abs(V[:, 1]) < 1e-9) & (V[:, 0] > 1)  # from the middle to the rim, along +x
    split = np.flatnonzero(on_slit)
    number = np.arange(len(V))
    number[split] = len(V) + np.arange(len(split))
    G[side] = number[F[side]]
    assert len(fans(G)[1]) == len(V) + len(split)
    uv = np.concatenate([V[:, :2], V[split, :2]])
    curves = trimming_curves(Atlas(Mesh(V, F), uv, G, np.zeros(len(F), np.int64)))
    slit = [c for c in curves if c.mate == 0]
    assert len(slit) == 2
    for c in slit:
        assert c.chart == 0
        np.testing.assert_allclose(c.uv, c.mate_uv)
        assert np.linalg.norm(np.diff(c.xyz, axis=0), axis=1).sum() == pytest.approx(50)
