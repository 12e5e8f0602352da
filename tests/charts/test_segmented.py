import pytest

from meshjig.charts import build_atlas, segmented
from meshjig.errors import ChartError
from meshjig.mesh.components import is_disc
from meshjig.mesh.types import Mesh
from tests.charts.helpers import all_turn_left
from tests.meshes import creased_box, cylinder, genus2, sphere, torus, two_components


@pytest.mark.parametrize("mesh", [sphere(800), torus(800), cylinder(400), creased_box(600), genus2(1000)])
def test_any_topology_is_cut_open_to_one_disc(mesh):
    atlas = build_atlas(Mesh(*mesh), method="single")
    assert atlas.n_charts == 1
    assert is_disc(atlas.F_uv)
    assert all_turn_left(atlas.uv, atlas.F_uv)
    assert atlas.facts["overlaps"] == 0
    assert atlas.facts["gate_share"] >= 0.8
    assert atlas.facts["method"] == "single"


def test_every_component_is_one_chart():
    assert build_atlas(Mesh(*two_components(1000)), method="single").n_charts == 2


def test_what_can_not_be_one_chart_is_refused_with_numbers(monkeypatch):
    monkeypatch.setattr(segmented, "_EFFORT", 0)  # nothing is glued
    with pytest.raises(ChartError, match=r"[2-9] charts are left, the largest with \d+%: use --charts auto"):
        build_atlas(Mesh(*sphere(800)), method="single")
