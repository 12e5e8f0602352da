"""Pieces that meet along a seam hold each other as others do, and stay whole."""

from pathlib import Path

import numpy as np
import pytest

import meshjig.layout.tiles
from meshjig.cut import cut_curves, merge_periodic
from meshjig.layout.interlock import interlock
from meshjig.layout.tiles import tile_layout
from meshjig.mesh.components import is_disc
from meshjig.mesh.halfedges import border_halfedges, edge_keys, edges, next_halfedge
from meshjig.mesh.measure import face_areas
from meshjig.mesh.subdivide import refine_long_edges
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.pipeline.prepare import chart, clean_scan
from meshjig.runtime.progress import Stages
from meshjig.scan import Scan

VASE = Path(__file__).parent.parent.parent / "data/vase.ply"


@pytest.fixture(scope="module")
def atlas():
    """Rings stacked on each other: tiles meet along plain circles."""
    options = Options.of(charts="periodic", pieces=60)
    mesh = clean_scan(VASE, options).mesh
    return chart(Scan(Mesh(*refine_long_edges(mesh.V, mesh.F, 6.0)), None, None, None), options)


def layouts(atlas, **asked):
    """Give the layout as it is, and without what is done to seams."""
    options = Options.of(charts="periodic", pieces=60, process="sla", **asked)
    layout = tile_layout(atlas, options, Stages())
    with pytest.MonkeyPatch.context() as context:
        context.setattr(meshjig.layout.tiles, "add_seam_knobs", lambda layout, *_: layout)
        return options, layout, tile_layout(atlas, options, Stages())


@pytest.fixture(scope="module")
def classic(atlas):
    return layouts(atlas)


def locks_of(layout):
    return interlock(merge_periodic(layout.cut, layout.outlines), layout.knobs, layout.piece_of_face)


def test_knobs_cross_the_seams_and_keep_every_promise(classic):
    options, layout, plain = classic
    before, after = locks_of(plain), locks_of(layout)
    assert before.interlocked_length(options.clearance) < 0.98
    assert after.interlocked_length(options.clearance) > 0.995
    facts = layout.stitching.facts
    assert facts.seam_knobs == len(layout.knobs.neck) - len(plain.knobs.neck)
    assert facts.seam_knobs >= 0.9 * facts.seam_borders > 4

    # those that were there are there; the new ones have sound necks and heads
    n = len(before.neck)
    np.testing.assert_array_equal(after.neck[:n], before.neck)
    assert after.neck[n:].min() >= options.min_neck + options.clearance
    assert (after.head[n:] / after.neck[n:]).min() > 1.3

    cut, piece = layout.cut, layout.piece_of_face
    assert layout.stitching.n_pieces == plain.stitching.n_pieces
    assert all(is_disc(cut.F[piece == p]) for p in range(layout.stitching.n_pieces))
    assert face_areas(cut.V, cut.F).sum() == pytest.approx(face_areas(plain.cut.V, plain.cut.F).sum())
    present = edge_keys(edges(cut.F).E, len(cut.V))
    assert np.isin(edge_keys(cut.cuts, len(cut.V)), present).all()


def test_no_knob_leaves_the_surface_at_an_open_border(classic):
    _, layout, plain = classic

    def rim(cut):
        h = border_halfedges(cut.F)
        ends = cut.F.ravel()[h], cut.F.ravel()[next_halfedge(h)]
        return np.linalg.norm(cut.V[ends[0]] - cut.V[ends[1]], axis=1).sum(), len(h)

    assert rim(layout.cut) == rim(plain.cut)


def test_figures_that_hold_each_other_by_shape_get_knobs_on_seams_alone(atlas):
    _, layout, plain = layouts(atlas, tile="escher:fish")
    there = len(plain.knobs.neck)  # the capstone's
    assert len(layout.knobs.neck) - there == layout.stitching.facts.seam_knobs > 1
    plane, space = cut_curves(layout.cut, layout.outlines)
    assert all(len(p) == len(x) for p, x in zip(plane, space, strict=True))
    low, high = layout.atlas.uv.min(0) - 1e-3, layout.atlas.uv.max(0) + 1e-3
    assert all(((p > low) & (p < high)).all() for p in plane)
