"""From a layout to solid pieces: the gap, the sheets, and what reaches through."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.cut import gap_outlines, overlay, transfer_pieces
from meshjig.layout.layout import Layout, Parts
from meshjig.layout.part_off import part_off
from meshjig.mesh.measure import face_areas
from meshjig.mesh.pieces import Pieces, piece_names
from meshjig.mesh.types import Bools, Ints, Mesh
from meshjig.options import Options
from meshjig.pipeline.ground import Ground
from meshjig.pipeline.notes import thin_places
from meshjig.pipeline.put_together import Assembled, Together, put_together
from meshjig.pipeline.through import stock_of, strays_on
from meshjig.scan import self_crossings
from meshjig.scan.thin_share import ThinShare
from meshjig.solid import Shell, shell
from meshjig.solid.kerf import KerfFacts, carve_pieces
from meshjig.solid.wall_edges import LabelledShell

__all__ = ["Beside", "Solids", "beside_charts", "is_planned", "leave_gaps", "make_solids"]

_HANDED_OVER = 3  # times that solids are made at most, where parts came off


class Solids(NamedTuple):
    """The pieces, and the layout that they were made of in the end."""

    layout: Layout
    parts: Parts
    pieces: Pieces
    facts: KerfFacts
    reaches: Bools  # (p,), pieces that reach through thin parts
    assembled: Assembled | None = None  # how they go together; None where walls are along the normals


class Beside(NamedTuple):
    """What needs no charts."""

    sheets: Shell
    n_crossings: int | None  # of the mesh with itself; None where they could not be counted
    crossing: Ints  # (k, 2), faces of the surface that do
    thin: ThinShare  # what of the mesh is thinner than the least wall
    uncut: ThinShare | None  # what would be cut through, were it not for an option


def beside_charts(mesh: Mesh, surface: Mesh, crowded: bool, options: Options) -> Beside:
    """Lay the two sheets, and look where the mesh crosses itself and where it is thin."""
    pairs = self_crossings(mesh.V, mesh.F)
    crossing = self_crossings(surface.V, surface.F) if pairs is not None and len(pairs) else None
    side, join = options.side, options.join
    sheets = shell(surface.V, surface.F, options.thickness, side=side, join=join, crowded=crowded)
    none: Ints = np.zeros((0, 2), np.int64)
    n_crossings = None if pairs is None else len(pairs)
    crossing = none if crossing is None else crossing
    return Beside(sheets, n_crossings, crossing, *thin_places(mesh, options))


def is_planned(options: Options) -> bool:
    """Tell whether walls are made so that pieces go in: for a gap that is cut from the solids."""
    return options.assembly != "off" and options.clearance > 0 and options.clearance_method == "solid"


def leave_gaps(layout: Layout, options: Options) -> Parts:
    """Cut the surface once more with the gap, unless the gap is to be taken from the solids."""
    if options.clearance == 0 or options.clearance_method == "solid":
        return Parts(layout.cut, layout.piece_of_face, 0.0)
    atlas = layout.atlas
    band = gap_outlines(
        atlas, layout.cut, layout.outlines, layout.piece_of_face, options.clearance, options.clearance_method
    )
    cut = overlay(atlas, band)
    piece, specks = transfer_pieces(layout.cut, layout.piece_of_face, cut)
    area = face_areas(cut.V, cut.F)
    return Parts(cut, piece, float(area[specks].sum() / max(area[piece >= 0].sum(), 1e-300)))


def make_solids(
    layout: Layout, parts: Parts, ground: Ground, sheets: Shell, options: Options, together: Together
) -> Solids:
    """Give the pieces their thickness, so that they go together; parts may be handed over for it."""
    if is_planned(options):
        made = put_together(layout, ground, sheets, options, together)
        layout, parts = made.layout, leave_gaps(made.layout, options)
        pieces = Pieces(tuple(piece_names(len(made.solids))), tuple(made.solids))
        return Solids(layout, parts, pieces, made.facts, made.reaches, made)
    clearance = options.clearance if options.clearance_method == "solid" else 0.0
    for left in reversed(range(_HANDED_OVER)):
        cut = parts.cut
        D, stock = stock_of(ground, layout, cut, sheets, options.clearance)
        outer = layout.carried(sheets.outer[ground.vertex], cut)
        label = ground.labels(layout) if stock else parts.piece_of_face
        solids, facts, strays = carve_pieces(LabelledShell(outer, cut.F, label, D), clearance, stock)
        if not strays or not left:
            break
        layout = part_off(layout, strays_on(layout, outer, solids, strays), options.min_piece)
        parts = leave_gaps(layout, options)
    pieces = Pieces(tuple(piece_names(len(solids))), tuple(solids))
    return Solids(layout, parts, pieces, facts, stock.reaches if stock else np.zeros(len(solids), bool))
