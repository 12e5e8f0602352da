"""With --unique every piece has one place; without it, pieces of a surface of revolution change places."""

from pathlib import Path

import pytest

from meshjig.layout.tiles import tile_layout
from meshjig.layout.unique import clashes
from meshjig.mesh.subdivide import refine_long_edges
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.pipeline.prepare import chart, clean_scan
from meshjig.runtime.progress import Stages
from meshjig.scan import Scan

VASE = Path(__file__).parent.parent.parent / "data/vase.ply"


@pytest.mark.parametrize("unique", [False, True])
def test_pieces_of_a_vase_change_places_unless_they_are_to_be_unique(unique):
    options = Options.of(charts="periodic", pieces=80, unique=unique)
    mesh = clean_scan(VASE, options).mesh
    surface = Mesh(*refine_long_edges(mesh.V, mesh.F, 6.0))
    layout = tile_layout(chart(Scan(surface, None, None, None), options), options, Stages())
    _, facts = clashes(layout, options.clearance)
    assert (facts["interchangeable_pieces"] == 0) == unique
    assert (facts["congruent_borders"] < 40) == unique  # plain borders are left to look alike
