"""From a mesh to a puzzle, a line a stage."""

from __future__ import annotations

import logging
from typing import Any

import numpy as np

from meshjig.charts import build_atlas
from meshjig.check import judge
from meshjig.check.interlock import interlock
from meshjig.check.outer_gap import outer_gap
from meshjig.cut import carry_pieces, cut_curves, gap_outlines, overlay
from meshjig.errors import OptionError
from meshjig.measure import face_areas, interpolate
from meshjig.options import Options
from meshjig.output.colours import colours
from meshjig.output.printable import printable
from meshjig.progress import Progress, Stages
from meshjig.puzzle import Curves, Piece, Puzzle
from meshjig.report import assemble_report
from meshjig.scan import read_scan, refine_long_edges, self_crossings
from meshjig.sizing import choose_tiles
from meshjig.solid import displacement, solidify
from meshjig.stitch import region_graph, stitch
from meshjig.tiling import FAMILIES, tile_charts
from meshjig.types import Atlas, CutMesh, Ints, Knobs, Mesh, Outlines, Stitching

__all__ = ["make_puzzle"]

log = logging.getLogger("meshjig")

WITHIN = 0.07  # of the wanted number of pieces; more off than that, the tiles are sized again
TRIES = 3


def make_puzzle(
    mesh: Any, *, progress: Progress | None = None, options: Options | None = None, **keywords: Any
) -> Puzzle:
    """Turn a triangle mesh into a jigsaw puzzle of its surface.

    Parameters
    ----------
    mesh : path, trimesh.Trimesh, or (V, F)
    progress : callable, optional
        Called with a stage's name and "start" or "end".
    options : Options, optional
        In place of keywords.
    **keywords
        The fields of `Options`.

    Returns
    -------
    Puzzle

    Raises
    ------
    MeshjigError
        One of its children; the sentence says what is wrong, where, and what to do.
    """
    options = options or Options.of(**keywords)
    stages = Stages(progress)
    with stages("scan"):
        scan = read_scan(mesh, size=options.size, faces=options.faces, cavities=options.cavities)
        scan.facts["self_crossings"] = self_crossings(scan.mesh.V, scan.mesh.F)
        surface = _with_short_edges(scan.mesh, options)
    with stages("charts"):
        atlas = build_atlas(surface, method=options.charts, seed=options.seed)
    outlines, knobs, cut, stitching = _cut_into_pieces(atlas, options, stages)
    piece_of_face = stitching.piece_of_region[cut.region]
    with stages("clearance"):
        parts, piece_of_part, discarded = _cut_gap(atlas, outlines, cut, piece_of_face, options)
    with stages("solid"):
        D, thickness = displacement(surface.V, surface.F, options.thickness)
        D = interpolate(D, surface.F, parts.vertex_face, parts.vertex_bary)
        raw, facts = solidify(parts.V, parts.F, piece_of_part, D)
        solids = [printable(solid.V, solid.F) for solid in raw]
    with stages("check"):
        locks = interlock(cut, knobs, piece_of_face)
        gap = outer_gap(parts.V, parts.F, piece_of_part, options.clearance)
        names = [f"piece_{i + 1:03d}" for i in range(len(solids))]
        verdict = judge(
            [(name, V, F) for name, (V, F) in zip(names, solids, strict=True)],
            neighbours=locks.pairs.tolist(),
            thickness=options.thickness,
            clearance=options.clearance,
        )
    tints = colours(len(solids), locks.pairs)
    pieces = [
        Piece(name, V, F, tuple(tint), i + 1)
        for i, (name, (V, F), tint) in enumerate(zip(names, solids, tints.tolist(), strict=True))
    ]
    report = assemble_report(
        options,
        scan,
        atlas,
        cut,
        stitching,
        piece_of_face,
        locks,
        verdict,
        solids,
        thickness | facts,
        gap,
        discarded,
        stages,
    )
    return Puzzle(pieces, report, _curves(cut, outlines, piece_of_face) if options.curves else Curves())


def _with_short_edges(mesh: Mesh, options: Options) -> Mesh:
    """Split edges longer than a quarter of a tile: no tile may fall inside a single face."""
    area = float(face_areas(mesh.V, mesh.F).sum())
    tile = options.piece_size or float(np.sqrt(area / options.pieces))
    _refuse_too_small_tiles(tile, area, options)
    return Mesh(*refine_long_edges(mesh.V, mesh.F, tile / 4))


def _refuse_too_small_tiles(tile: float, area: float, options: Options) -> None:
    neck = FAMILIES[options.tile](8).neck_width
    smallest = (options.clearance + 0.1) / neck
    if tile >= smallest:
        return
    if options.clearance > neck * np.sqrt(area / 100):
        raise OptionError(
            f"clearance: {options.clearance:g} mm is wider than a knob's neck ({neck * tile:.2g} mm)",
            hint=f"use less than {max(neck * tile - 0.1, 0):.2g} mm, or larger pieces",
        )
    raise OptionError(
        f"pieces: tiles of {tile:.2g} mm are too small for a clearance of {options.clearance:g} mm",
        hint=f"use at most {max(int(area / smallest**2), 1)} pieces, or a larger size",
    )


def _cut_into_pieces(
    atlas: Atlas, options: Options, stages: Stages
) -> tuple[Outlines, Knobs, CutMesh, Stitching]:
    """Tile, cut and stitch; again with other tiles when the number of pieces is too far off."""
    wanted, tried = options.pieces, []
    least_border = options.min_neck + options.clearance
    for _ in range(TRIES):
        with stages("tiling"):
            choice = choose_tiles(atlas, wanted, options.stitch, least_border, options.piece_size)
            outlines, knobs = tile_charts(
                atlas,
                choice.size,
                family=options.tile,
                shift=choice.shift,
                min_neck=options.min_neck,
                seed=options.seed,
            )
        with stages("cut"):
            cut = overlay(atlas, outlines)
        with stages("stitch"):
            stitching = stitch(region_graph(cut), options.stitch, choice.size**2, least_border)
        tried.append((outlines, knobs, cut, stitching))
        n = stitching.n_pieces
        log.info("tiles of %.2f mm give %d pieces (%d expected)", choice.size, n, choice.expected)
        if options.piece_size or abs(n - options.pieces) <= WITHIN * options.pieces:
            break
        wanted = max(1, round(wanted * options.pieces / n))
    return min(tried, key=lambda made: abs(made[3].n_pieces - options.pieces))


def _cut_gap(
    atlas: Atlas, outlines: Outlines, cut: CutMesh, piece_of_face: Ints, options: Options
) -> tuple[CutMesh, Ints, float]:
    """Cut the surface once more, with the gap; also give the share of the area that it cut off."""
    if options.clearance == 0:
        return cut, piece_of_face, 0.0
    band = gap_outlines(atlas, cut, outlines, piece_of_face, options.clearance, options.clearance_method)
    parts = overlay(atlas, band)
    piece, specks = carry_pieces(atlas.mesh, cut, piece_of_face, parts)
    area = face_areas(parts.V, parts.F)
    return parts, piece, float(area[specks].sum() / max(area[piece >= 0].sum(), 1e-300))


def _curves(cut: CutMesh, outlines: Outlines, piece_of_face: Ints) -> Curves:
    plane, space = cut_curves(cut, outlines)
    return Curves(plane, space)
