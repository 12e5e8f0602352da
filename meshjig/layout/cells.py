"""The layout of cells: from a surface to pieces of equal area, with a knob on every border that has room."""

from __future__ import annotations

import logging
from dataclasses import asdict
from typing import NamedTuple

import numpy as np

from meshjig.assembly import ShellRays, border_edges, needed_tilt, peel, room_to_lean
from meshjig.cells import CellMesh, KnobLayout, WaysOut, cell_atlas, grow_cells, knob_outlines
from meshjig.cut import overlay
from meshjig.errors import CutError
from meshjig.layout.congruent import LEAST_DIFFERENCE, clashes
from meshjig.layout.layout import Layout
from meshjig.layout.stitch import region_graph, stitch
from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import face_areas, vertex_normals
from meshjig.mesh.types import Atlas, Mesh
from meshjig.options import Options
from meshjig.runtime.progress import Stages

__all__ = ["cell_layout"]

log = logging.getLogger("meshjig")

PASSES = 2  # the second makes cells larger or smaller by what their knobs take and give
MANY = 600  # cells from which one pass has to do: knobs come out even among so many, and time counts
REDRAWN = 6  # times that all knobs are drawn, where each has to be unique
DIFFERENT = 0.5  # how random they are then, at least
AFAR = 1_000_003  # between the seeds of two drawings
OFF_RIDGES = (0.5,)  # spacings that a radian of bend adds to a path; the first that does
MISSED = 0.03  # of the cells asked for
NEVER = 2.0  # a share of a border that no two pieces have: cells are whole as they are


class _Wish(NamedTuple):
    """What cells shall be like."""

    n: int
    size: float  # mm, edge of a square as large as one
    up: Floats  # (3,), unit, which way the puzzle grows
    off_ridges: float = 0.0  # spacings that a radian of bend adds to a path


class _Grown(NamedTuple):
    """Cells with knobs on their borders."""

    cells: CellMesh
    atlas: Atlas
    knobs: KnobLayout
    ways: WaysOut | None  # how they are put together; None where nobody minds


def cell_layout(surface: Mesh, options: Options, stages: Stages, up: Floats | None = None) -> Layout:
    """Cut a surface into cells, put knobs on their borders, and cut again along these.

    Parameters
    ----------
    surface : Mesh
    options : Options
    stages : Stages, hears of cells, knobs, cut and stitch
    up : (3,) float64, unit, optional
        Which way the puzzle grows when it is put together; z where it is not given.
    """
    up = np.array([0.0, 0.0, 1.0]) if up is None else up
    area = float(face_areas(surface.V, surface.F).sum())
    n = options.pieces if options.piece_size is None else max(1, round(area / options.piece_size**2))
    size = float(np.sqrt(area / n))
    grown, wish = _first_grown(surface, _Wish(n, size, up), options, stages)
    for _ in range(PASSES - 1 if n < MANY else 0):
        try:
            grown = _grown(surface, wish, options, stages, grown)
        except CutError as error:  # rings, around holes; those before were less even, but whole
            log.info("cells of even areas were not found: %s", error)
            break
    cells, atlas, knobs, _ = grown
    log.info("cells: %s; knobs: %s", cells.facts, knobs.facts)
    layout = _cut(cells, atlas, knobs, area / n, options, stages)
    return _without_clashes(layout, grown, size, options, stages) if options.unique else layout


def _cut(
    cells: CellMesh, atlas: Atlas, knobs: KnobLayout, mean_area: float, options: Options, stages: Stages
) -> Layout:
    with stages("cut"):
        cut = overlay(atlas, knobs.outlines)
    with stages("stitch"):
        stitching = stitch(region_graph(cut), NEVER, mean_area, smallest=options.min_piece)
    atlas = Atlas(
        atlas.mesh, atlas.uv, atlas.F_uv, atlas.chart_of_face, dict(atlas.facts) | asdict(knobs.facts)
    )
    return Layout(atlas, knobs.outlines, knobs.knobs, cut, stitching, cells)


def _without_clashes(layout: Layout, grown: _Grown, size: float, options: Options, stages: Stages) -> Layout:
    """Draw all knobs again for as long as borders look alike, and give the layout with the fewest such."""
    (cells, atlas, _, ways), best, fewest = grown, layout, np.inf
    for draw in range(1, REDRAWN + 1):
        with stages("unique"):
            alike = clashes(layout, max(options.clearance, LEAST_DIFFERENCE))[1].congruent_borders
        if alike < fewest:
            best, fewest = layout, alike
        if not alike or draw == REDRAWN:
            break
        with stages("knobs"):
            knobs = _knobs(atlas, size, options, seed=options.seed + draw * AFAR, ways=ways)
        layout = _cut(cells, atlas, knobs, size**2, options, stages)
    return best


def _first_grown(surface: Mesh, wish: _Wish, options: Options, stages: Stages) -> tuple[_Grown, _Wish]:
    """Grow cells that keep off ridges as far as that leaves as many discs as asked for."""
    for off_ridges in OFF_RIDGES if options.assembly != "off" else ():
        try:
            grown = _grown(surface, wish._replace(off_ridges=off_ridges), options, stages)
        except CutError:
            continue
        if abs(grown.cells.n_cells - wish.n) <= MISSED * wish.n:
            return grown, wish._replace(off_ridges=off_ridges)
    return _grown(surface, wish, options, stages), wish


def _grown(
    surface: Mesh, wish: _Wish, options: Options, stages: Stages, before: _Grown | None = None
) -> _Grown:
    with stages("cells"):
        cells = grow_cells(
            surface,
            wish.n,
            seed=options.seed,
            style=options.style,
            crease_aware=options.crease_aware,
            off_ridges=wish.off_ridges,
            targets=None if before is None else _wanted_areas(before.cells, before.knobs),
            start=None if before is None else before.cells.seeds,
        )
        atlas = cell_atlas(cells)
    with stages("assembly"):
        same = before is not None and before.cells.n_cells == cells.n_cells
        ways = before.ways if before and same else _ways_out(cells, options, wish.up)
    with stages("knobs"):
        knobs = _knobs(atlas, wish.size, options, seed=options.seed, like=before and before.knobs, ways=ways)
    return _Grown(cells, atlas, knobs, ways)


def _ways_out(cells: CellMesh, options: Options, up: Floats) -> WaysOut | None:
    """Plan how cells would be put together, if knobs could stand anywhere on their borders."""
    if options.assembly == "off":
        return None
    (V, F), cell = cells.mesh, cells.cell
    D = -options.thickness * vertex_normals(V, F)
    b = border_edges(V, F, cell, D, np.ones(len(V), bool))
    plan = peel(cells.mesh, cell, b, needed_tilt(b, room_to_lean(b, V, D, ShellRays(V, F, D))), up)
    return WaysOut(plan.rank, plan.way)


def _knobs(
    atlas: Atlas,
    size: float,
    options: Options,
    *,
    seed: int,
    like: KnobLayout | None = None,
    ways: WaysOut | None = None,
) -> KnobLayout:
    return knob_outlines(
        atlas,
        size=size,
        knob_size=options.knob_size,
        min_neck=options.min_neck + options.clearance,
        random=max(options.random, DIFFERENT if options.unique else 0.0),
        crease_aware=options.crease_aware,
        seed=seed,
        like=like,
        ways=ways,
    )


def _wanted_areas(cells: CellMesh, knobs: KnobLayout) -> Floats:
    """Give the areas that cells need so that pieces come out equal, knobs counted."""
    gained = np.zeros(cells.n_cells)
    np.add.at(gained, knobs.moved[:, 0], -knobs.moved_mm2)
    np.add.at(gained, knobs.moved[:, 1], knobs.moved_mm2)
    mean = float(face_areas(cells.mesh.V, cells.mesh.F).sum()) / cells.n_cells
    return np.maximum(mean - gained, 0.3 * mean)
