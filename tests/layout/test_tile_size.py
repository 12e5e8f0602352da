"""Tiles are sized so that the number of pieces comes out as asked."""

import numpy as np
import pytest

from meshjig.charts import build_atlas
from meshjig.cut.overlay import overlay
from meshjig.layout.stitch import region_graph, stitch
from meshjig.layout.tile_size import choose_tiles
from meshjig.mesh.types import Mesh
from meshjig.tiling import squares, tile_charts
from meshjig.tiling.template import classic
from tests.meshes import half_sphere, sphere, torus
from tests.tiling.charts import ring_chart
from tests.tiling.units import bricks, waves

UNITS = {"squares": squares(classic), "bricks": bricks(), "waves": waves()}


@pytest.fixture(scope="module", params=[sphere, torus, half_sphere], ids=lambda shape: shape.__name__)
def atlas(request):
    return build_atlas(Mesh(*request.param(4000)))


@pytest.mark.parametrize("name", sorted(UNITS))
@pytest.mark.parametrize("pieces", [25, 60, 150])
def test_expected_and_real_numbers_agree_with_what_was_asked(atlas, pieces, name):
    unit = UNITS[name]
    choice = choose_tiles(atlas, pieces, 0.3, unit=unit)
    outlines, _ = tile_charts(atlas, choice.size, unit=unit, placings=choice.placings)
    real = stitch(region_graph(overlay(atlas, outlines)), 0.3, choice.size**2).n_pieces
    assert choice.expected == pytest.approx(pieces, rel=0.08)
    assert real == pytest.approx(choice.expected, rel=0.1, abs=3)


@pytest.mark.parametrize("name", sorted(UNITS))
@pytest.mark.parametrize("pieces", [24, 60, 200])
def test_on_a_ring_copies_count_as_one_piece(pieces, name):
    choice = choose_tiles(ring_chart(), pieces, 0.3, unit=UNITS[name])
    assert choice.expected == pytest.approx(pieces, rel=0.08)
    area = 157.0 * 80.0 / choice.size**2
    assert area == pytest.approx(pieces, rel=0.25)
    assert choice.placings[0].period == 157.0


def test_a_given_size_is_kept(atlas):
    choice = choose_tiles(atlas, 100, 0.3, size=17.5, unit=UNITS["squares"])
    assert choice.size == 17.5
    assert {placing.size for placing in choice.placings} == {17.5}


def test_a_given_angle_is_kept(atlas):
    choice = choose_tiles(atlas, 60, 0.3, unit=UNITS["squares"], angle=20.0)
    assert {placing.angle for placing in choice.placings if not placing.period} <= {20.0}
    assert choice.expected == pytest.approx(60, rel=0.08)


def test_regions_cover_the_surface(atlas):
    outlines, _ = tile_charts(atlas, 20.0)
    cut = overlay(atlas, outlines)
    graph = region_graph(cut)
    V, F = atlas.mesh.V, atlas.mesh.F
    area = np.linalg.norm(np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), axis=1).sum() / 2
    assert graph.area.sum() == pytest.approx(area)
    assert (graph.pairs[:, 0] < graph.pairs[:, 1]).all()
    cuts = np.linalg.norm(np.diff(cut.V[cut.cuts], axis=1)[:, 0], axis=1).sum()
    assert graph.length[~graph.seam].sum() == pytest.approx(cuts)
