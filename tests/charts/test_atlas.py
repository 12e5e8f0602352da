import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from meshjig.charts import build_atlas
from meshjig.charts.transfer.transfer_chart import ChartTransfer
from meshjig.errors import ChartError, MeshjigError, OptionError
from meshjig.mesh.components import is_disc
from meshjig.mesh.halfedges import compact, edges
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Mesh
from tests.charts.helpers import all_turn_left, corner_angles, signed_areas
from tests.meshes import (
    Shape,
    closed_cylinder,
    creased_box,
    cylinder,
    disc,
    genus2,
    half_sphere,
    inside_out,
    joined,
    moved,
    noisy,
    open_cup,
    sphere,
    torus,
    two_components,
)
from tests.strategies import meshes


def assert_sound(atlas):
    """Every chart is a disc, the right way up, one to one, and apart from the others."""
    G = atlas.F_uv
    assert all_turn_left(atlas.uv, G)
    assert np.unique(G).tolist() == list(range(len(atlas.uv)))
    charts = [atlas.chart_of_face == c for c in range(atlas.n_charts)]
    assert all(is_disc(G[c]) for c in charts)
    shapes = [shapely.union_all(shapely.polygons(atlas.uv[G[c]])) for c in charts]
    for shape, c in zip(shapes, charts, strict=True):
        assert shape.area == pytest.approx(signed_areas(atlas.uv, G[c]).sum(), rel=1e-6)
    for i, shape in enumerate(shapes):
        assert all(shape.distance(other) >= 5 - 1e-6 for other in shapes[:i])


def edges_cut_inside(atlas):
    """Give the edges inside charts over which corners lie apart."""
    F, G = atlas.mesh.F.ravel(), atlas.F_uv.ravel()
    owner = np.full(len(atlas.uv), -1)
    owner[G] = F
    assert (owner[G] == F).all()
    e = edges(atlas.mesh.F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    apart = atlas.chart_of_face[h // 3] != atlas.chart_of_face[e.twin[h] // 3]
    far_end = G[np.where(e.twin[h] % 3 == 2, e.twin[h] - 2, e.twin[h] + 1)]
    assert (G[h] != far_end)[apart].all()
    return e.E[e.edge_of_halfedge[h[(G[h] != far_end) & ~apart]]]


SHAPES = {
    "sphere of 100 faces": sphere(100),
    "sphere": sphere(800),
    "torus": torus(700),
    "genus 2": genus2(800),
    "cylinder": cylinder(600),
    "cup": open_cup(600),
    "box": creased_box(400),
    "box of 12 faces": creased_box(12),
    "two components": two_components(800),
    "noisy torus": noisy(torus(600), 0.3),
    "noisy sphere, heavy": noisy(sphere(9500), 0.3),
    "one face": disc(6),
    "a sphere and crumbs": joined(
        sphere(500), moved(sphere(20, 1.0), [60, 0, 0]), moved(disc(6, 1.0), [70, 0, 0])
    ),
}


@pytest.mark.parametrize("name", SHAPES)
def test_any_topology_gets_sound_charts(name):
    atlas = build_atlas(Mesh(*SHAPES[name]))
    assert_sound(atlas)
    edges_cut_inside(atlas)
    assert atlas.facts["flips"] == atlas.facts["overlaps"] == 0
    assert atlas.facts["n_charts"] == atlas.n_charts


@settings(max_examples=4, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(meshes(faces=(100, 400), noise=0.4), st.sampled_from(["lscm", "arap", "slim", "xatlas"]))
def test_any_mesh_gets_sound_charts_by_any_method(mesh, method):
    atlas = build_atlas(Mesh(*mesh), method=method)
    assert_sound(atlas)
    edges_cut_inside(atlas)


def test_a_nearly_flat_chart_keeps_area_and_angles():
    V, F = half_sphere(2000)
    cap, kept = compact(F[V[F].mean(1)[:, 2] > 35])
    atlas = build_atlas(Mesh(V[kept], cap))
    assert atlas.n_charts == 1
    off = np.abs(corner_angles(atlas.uv, atlas.F_uv) - corner_angles(V[kept], cap))
    assert np.quantile(off, 0.95) < 10
    assert signed_areas(atlas.uv, atlas.F_uv).sum() == pytest.approx(face_areas(V[kept], cap).sum(), rel=0.02)


def test_equal_input_gives_equal_geometry():
    first, second = (build_atlas(Mesh(*torus(600)), seed=5) for _ in range(2))
    assert (first.uv == second.uv).all()
    assert (first.F_uv == second.F_uv).all()


def test_slivers_are_no_trouble():
    V, F = disc(600)
    thin = V * [1, 1e-5, 1]
    assert_sound(build_atlas(Mesh(np.ascontiguousarray(thin), F)))


def test_faces_without_area_are_no_trouble():
    V, F = sphere(800)
    V[F[100, 0]] = V[F[100, 1]]
    V[F[700, 0]] = (V[F[700, 1]] + V[F[700, 2]]) / 2
    V[F[300:310].ravel()] = V[F[300, 0]]
    atlas = build_atlas(Mesh(V, F))
    assert_sound(atlas)
    assert atlas.n_charts <= 5


def test_lengths_scale_with_the_model():
    V, F = noisy(open_cup(500), 0.1)  # without symmetry, which rounding would break
    small, large = build_atlas(Mesh(V, F)), build_atlas(Mesh(10 * V, F))
    assert signed_areas(large.uv, large.F_uv).sum() == pytest.approx(
        100 * signed_areas(small.uv, small.F_uv).sum(), rel=1e-3
    )


def test_what_can_not_be_charted_is_refused_with_a_sentence():
    V, F = sphere(100)
    with pytest.raises(OptionError, match="unknown method"):
        build_atlas(Mesh(V, F), method="magic")
    with pytest.raises(OptionError, match="uv needs the mesh as it was loaded"):
        build_atlas(Mesh(V, F), method="uv")
    with pytest.raises(OptionError, match="unknown name 'depth'"):
        build_atlas(Mesh(V, F), xatlas_options={"depth": 1})
    with pytest.raises(ChartError, match="not manifold"):
        build_atlas(Mesh(V, np.concatenate([F, F[:1], F[:1]])))
    with pytest.raises(ChartError, match="empty"):
        build_atlas(Mesh(V, F[:0]))
    with pytest.raises(MeshjigError):
        build_atlas(Mesh(np.zeros_like(V), F))


def test_an_inward_mesh_is_charted_as_it_is():
    assert_sound(build_atlas(Mesh(*inside_out(sphere(500)))))


def test_gluing_leaves_fewer_charts_and_the_facts_tell():
    mesh = Mesh(*torus(9200))  # with a proxy
    whole, glued = (build_atlas(mesh, method="slim", zipped=zipped) for zipped in (False, True))
    assert len(edges_cut_inside(whole)) == 0 < len(edges_cut_inside(glued))
    assert glued.n_charts <= 2 / 3 * whole.n_charts
    facts = glued.facts
    assert facts["gate_share"] > 0.97
    assert facts["seam_over_sqrt_area"] < 8
    assert facts["n_charts_before_zip"] == whole.n_charts == glued.n_charts + facts["zipped"]
    assert facts["seam_before_zip"] == pytest.approx(whole.facts["seam_over_sqrt_area"])
    assert facts["seam_over_sqrt_area"] < facts["seam_before_zip"]
    assert f"glued from {whole.n_charts}" in facts["reason"]


@pytest.mark.parametrize("mesh", [genus2(1500), sphere(9000), half_sphere(2000)])
def test_conformal_charts_are_cut_until_they_are_true_to_size(mesh):
    facts = build_atlas(Mesh(*mesh), method="lscm").facts
    assert facts["gate_share"] >= 0.97
    assert facts["flips"] == facts["overlaps"] == 0
    assert facts["n_charts"] <= 16


def test_where_a_glued_chart_can_not_be_transferred_its_parts_are(monkeypatch):
    apply = ChartTransfer.apply
    sizes = []

    def only_regions(self, chart):
        is_region = len(np.unique(self._proxy_region[chart.faces])) == 1
        sizes.append(len(chart.faces))
        return apply(self, chart) if is_region else None

    monkeypatch.setattr(ChartTransfer, "apply", only_regions)
    atlas = build_atlas(Mesh(*sphere(10000)), method="slim")
    assert_sound(atlas)
    assert len(edges_cut_inside(atlas)) == 0
    assert atlas.facts["zipped"] == 0
    assert len(sizes) > atlas.n_charts


def test_auto_takes_rings_for_a_tube_and_says_so():
    V, F = closed_cylinder(3000)
    atlas = build_atlas(Mesh(V * [1, 1, 2], F))
    assert atlas.facts["method"] == "periodic"
    assert atlas.period is not None
    assert atlas.facts["gate_share"] >= 0.97
    assert atlas.facts["reason"].startswith("periodic: ")


def test_auto_does_not_take_rings_for_what_is_no_tube():
    assert build_atlas(Mesh(*torus(600))).facts["method"] == "slim"


def test_each_component_has_its_own_method_in_auto():
    V, F = closed_cylinder(3000)
    mesh = joined(Shape(V * [1, 1, 2], F), moved(torus(600), [200, 0, 0]))
    atlas = build_atlas(Mesh(*mesh))
    assert atlas.facts["method"] == "periodic+slim"
    assert (atlas.period > 0).any()
    assert not (atlas.period > 0).all()
