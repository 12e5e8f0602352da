"""The layout of cells: from a surface to pieces of equal area, with a knob on every border that has room."""

from __future__ import annotations

import logging
from dataclasses import asdict

import numpy as np

from meshjig.cells import CellMesh, KnobLayout, cell_atlas, grow_cells, knob_outlines
from meshjig.cut import overlay
from meshjig.errors import CutError
from meshjig.layout.congruent import LEAST_DIFFERENCE, clashes
from meshjig.layout.layout import Layout
from meshjig.layout.stitch import region_graph, stitch
from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import face_areas
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
NEVER = 2.0  # a share of a border that no two pieces have: cells are whole as they are


def cell_layout(surface: Mesh, options: Options, stages: Stages) -> Layout:
    """Cut a surface into cells, put knobs on their borders, and cut again along these.

    Parameters
    ----------
    surface : Mesh
    options : Options
    stages : Stages, hears of cells, knobs, cut and stitch
    """
    area = float(face_areas(surface.V, surface.F).sum())
    n = options.pieces if options.piece_size is None else max(1, round(area / options.piece_size**2))
    size = float(np.sqrt(area / n))
    cells, atlas, knobs = _grown(surface, n, size, options, stages)
    for _ in range(PASSES - 1 if n < MANY else 0):
        try:
            cells, atlas, knobs = _grown(surface, n, size, options, stages, (cells, knobs))
        except CutError as error:  # rings, around holes; those before were less even, but whole
            log.info("cells of even areas were not found: %s", error)
            break
    log.info("cells: %s; knobs: %s", cells.facts, knobs.facts)
    layout = _cut(cells, atlas, knobs, area / n, options, stages)
    return _without_clashes(layout, cells, atlas, size, options, stages) if options.unique else layout


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


def _without_clashes(
    layout: Layout, cells: CellMesh, atlas: Atlas, size: float, options: Options, stages: Stages
) -> Layout:
    """Draw all knobs again for as long as borders look alike, and give the layout with the fewest such."""
    best, fewest = layout, np.inf
    for draw in range(1, REDRAWN + 1):
        with stages("unique"):
            alike = clashes(layout, max(options.clearance, LEAST_DIFFERENCE))[1].congruent_borders
        if alike < fewest:
            best, fewest = layout, alike
        if not alike or draw == REDRAWN:
            break
        with stages("knobs"):
            knobs = _knobs(atlas, size, options, seed=options.seed + draw * AFAR)
        layout = _cut(cells, atlas, knobs, size**2, options, stages)
    return best


def _grown(
    surface: Mesh,
    n: int,
    size: float,
    options: Options,
    stages: Stages,
    before: tuple[CellMesh, KnobLayout] | None = None,
) -> tuple[CellMesh, Atlas, KnobLayout]:
    with stages("cells"):
        cells = grow_cells(
            surface,
            n,
            seed=options.seed,
            style=options.style,
            crease_aware=options.crease_aware,
            targets=None if before is None else _wanted_areas(*before),
            start=None if before is None else before[0].seeds,
        )
        atlas = cell_atlas(cells)
    with stages("knobs"):
        knobs = _knobs(atlas, size, options, seed=options.seed, like=before and before[1])
    return cells, atlas, knobs


def _knobs(
    atlas: Atlas, size: float, options: Options, *, seed: int, like: KnobLayout | None = None
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
    )


def _wanted_areas(cells: CellMesh, knobs: KnobLayout) -> Floats:
    """Give the areas that cells need so that pieces come out equal, knobs counted."""
    gained = np.zeros(cells.n_cells)
    np.add.at(gained, knobs.moved[:, 0], -knobs.moved_mm2)
    np.add.at(gained, knobs.moved[:, 1], knobs.moved_mm2)
    mean = float(face_areas(cells.mesh.V, cells.mesh.F).sum()) / cells.n_cells
    return np.maximum(mean - gained, 0.3 * mean)
