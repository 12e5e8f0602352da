"""Solids and the layout that they are of."""

import numpy as np
import trimesh

from meshjig.layout.cells import cell_layout
from meshjig.mesh.mesh import Mesh
from meshjig.options import Options
from meshjig.pipeline import solids
from meshjig.pipeline.ground import surface_to_lay_out
from meshjig.pipeline.put_together import Together
from meshjig.runtime.progress import Stages
from meshjig.solid import shell


def test_pieces_are_those_of_the_layout_even_where_parts_come_off_every_time(monkeypatch):
    ball = trimesh.creation.icosphere(3, 20.0)
    mesh = Mesh(np.asarray(ball.vertices, float), np.asarray(ball.faces, np.int64))
    options = Options.of(pieces=6, assembly="off")
    ground = surface_to_lay_out(mesh, options)
    layout = cell_layout(ground.mesh, options, Stages(None))
    carve = solids.carve_pieces
    monkeypatch.setattr(solids, "carve_pieces", lambda *a: (*carve(*a)[:2], {0: ()}))

    def half_of_the_first(layout, *_):
        z = layout.cut.V[layout.cut.F].mean(axis=1)[:, 2]
        own = layout.piece_of_face == 0
        return [own & (z > np.median(z[own]))]

    monkeypatch.setattr(solids, "strays_on", half_of_the_first)
    sheets = shell(*mesh, options.thickness)
    together = Together(np.eye(3)[2], np.zeros((0, 2), np.int64))
    made = solids.make_solids(layout, solids.leave_gaps(layout, options), ground, sheets, options, together)
    assert len(made.pieces) == made.layout.stitching.n_pieces == len(made.reaches)
    facts = made.layout.stitching.facts
    assert facts.parted + facts.handed_over == 2  # solids were made three times
