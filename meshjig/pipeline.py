"""From a mesh to a puzzle, a line a stage."""

from __future__ import annotations

import logging
from typing import Any

import numpy as np

from meshjig.background import Background
from meshjig.charts import build_atlas
from meshjig.check import judge, touched_pieces
from meshjig.check.interlock import interlock
from meshjig.cut import carry_pieces, cut_curves, gap_outlines, overlay
from meshjig.errors import OptionError
from meshjig.layout import Layout, Parts
from meshjig.measure import face_areas, interpolate
from meshjig.options import Options
from meshjig.output.colours import colours
from meshjig.output.printable import printable
from meshjig.progress import Progress, Stages, peak_memory_mb
from meshjig.puzzle import Curves, Piece, Puzzle
from meshjig.report import assemble_report
from meshjig.scan import read_scan, refine_long_edges, self_crossings
from meshjig.sizing import choose_tiles
from meshjig.solid import Shell, kerf, shell
from meshjig.stitch import region_graph, stitch
from meshjig.tiling import FAMILIES, tile_charts
from meshjig.topology import border_halfedges, components
from meshjig.types import Atlas, Floats, Ints, Mesh

__all__ = ["make_puzzle"]

log = logging.getLogger("meshjig")

WITHIN = 0.07  # of the wanted number of pieces; more off than that, the tiles are sized again
TRIES = 3
FEWEST = 2  # pieces that a puzzle can have
WORTH_A_CHILD = 20_000  # faces; below, a child process takes longer to start than its work


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
        scan = read_scan(
            mesh,
            size=options.size,
            faces=options.faces,
            cavities=options.cavities,
            resurface=options.resurface,
        )
        surface = _with_short_edges(scan.mesh, options)
    beside = Background(_beside_charts, scan.mesh, surface, options, alone=len(surface.F) < WORTH_A_CHILD)
    try:
        with stages("charts"):
            atlas = build_atlas(surface, method=options.charts, seed=options.seed)
        layout = _cut_into_pieces(atlas, options, stages)
        _refuse_a_hollow_piece(layout)
        with stages("clearance"):
            parts = _leave_gaps(atlas, layout, options)
        with stages("solid"):
            sheets, scan.facts["self_crossings"], crossing = beside.result()
            solids, solid_facts = _solids(surface, parts, sheets, options)
    except BaseException:
        beside.cancel()
        raise
    with stages("check"):
        locks = interlock(layout.cut, layout.knobs, layout.piece_of_face)
        names = [f"piece_{i + 1:03d}" for i in range(len(solids))]
        touched = touched_pieces(crossing, layout.cut.parent, layout.piece_of_face)
        exempt = [names[i] for i in sorted(touched)]
        verdict = judge(
            [(name, V, F) for name, (V, F) in zip(names, solids, strict=True)],
            neighbours=locks.pairs.tolist(),
            thickness=options.thickness,
            clearance=options.clearance,
            min_wall=options.min_wall,
            exempt_pieces=exempt,
        )
        on_surface = parts if options.clearance_method != "solid" else None
        report = assemble_report(
            options, scan, atlas, layout, on_surface, locks, verdict, solids, solid_facts
        )
    report["exempt_pieces"] = exempt
    report |= {"timings_s": dict(stages.seconds), "peak_memory_mb": peak_memory_mb()}
    tints = colours(len(solids), locks.pairs).tolist()
    pieces = [
        Piece(name, V, F, tuple(tint), i + 1)
        for i, (name, (V, F), tint) in enumerate(zip(names, solids, tints, strict=True))
    ]
    curves = Curves(*cut_curves(layout.cut, layout.outlines)) if options.curves else Curves()
    return Puzzle(pieces, report, curves)


def _beside_charts(mesh: Mesh, surface: Mesh, options: Options) -> tuple[Shell, int | None, Ints]:
    """Do what needs no charts: the two sheets, how often the mesh crosses itself, and in which faces."""
    pairs = self_crossings(mesh.V, mesh.F)
    crossing = self_crossings(surface.V, surface.F) if pairs is not None and len(pairs) else None
    sheets = shell(surface.V, surface.F, options.thickness, side=options.side, join=options.join)
    none: Ints = np.zeros((0, 2), np.int64)
    return sheets, None if pairs is None else len(pairs), none if crossing is None else crossing


def _with_short_edges(mesh: Mesh, options: Options) -> Mesh:
    """Split edges longer than a quarter of a tile: no tile may fall inside a single face."""
    area = float(face_areas(mesh.V, mesh.F).sum())
    tile = options.piece_size or float(np.sqrt(area / options.pieces))
    _refuse_too_small_tiles(tile, area, options)
    return Mesh(*refine_long_edges(mesh.V, mesh.F, tile / 4))


def _refuse_too_small_tiles(tile: float, area: float, options: Options) -> None:
    neck = FAMILIES[options.tile](8).neck_width
    smallest = (2 * options.clearance + 0.1) / neck  # half of the neck is left
    if tile >= smallest:
        return
    most, widest = int(area / smallest**2), max(neck * tile / 2 - 0.05, 0.0)
    larger = f"pieces of at least {smallest:.2g} mm" if options.piece_size else f"at most {most} pieces"
    raise OptionError(
        f"tiles of {tile:.2g} mm have a knob's neck of {neck * tile:.2g} mm, "
        f"too narrow for a clearance of {options.clearance:g} mm",
        hint=f"use a clearance of at most {widest:.2g} mm" + (f", or {larger}" if most >= FEWEST else ""),
    )


def _cut_into_pieces(atlas: Atlas, options: Options, stages: Stages) -> Layout:
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
                min_neck=least_border,
                seed=options.seed,
            )
        with stages("cut"):
            cut = overlay(atlas, outlines)
        with stages("stitch"):
            stitching = stitch(region_graph(cut), options.stitch, choice.size**2, least_border)
        tried.append(Layout(outlines, knobs, cut, stitching))
        n = stitching.n_pieces
        log.info("tiles of %.2f mm give %d pieces (%d expected)", choice.size, n, choice.expected)
        if options.piece_size or abs(n - options.pieces) <= WITHIN * options.pieces:
            break
        wanted = max(1, round(wanted * options.pieces / n))
    return min(tried, key=lambda layout: abs(layout.stitching.n_pieces - options.pieces))


def _refuse_a_hollow_piece(layout: Layout) -> None:
    """Refuse to make the model's main part, where it is closed, a single piece: it would be hollow."""
    F, piece = layout.cut.F, layout.piece_of_face
    n, component = components(F)
    main = component == np.bincount(component, face_areas(layout.cut.V, F), n).argmax()
    open_parts = component[border_halfedges(F) // 3]
    if np.ptp(piece[main]) == 0 and not np.isin(component[main][:1], open_parts).any():
        raise OptionError("pieces: the model would be a single hollow piece", hint="ask for more pieces")


def _leave_gaps(atlas: Atlas, layout: Layout, options: Options) -> Parts:
    """Cut the surface once more with the gap, unless the gap is to be taken from the solids."""
    if options.clearance == 0 or options.clearance_method == "solid":
        return Parts(layout.cut, layout.piece_of_face, 0.0)
    band = gap_outlines(
        atlas, layout.cut, layout.outlines, layout.piece_of_face, options.clearance, options.clearance_method
    )
    cut = overlay(atlas, band)
    piece, specks = carry_pieces(atlas.mesh, layout.cut, layout.piece_of_face, cut)
    area = face_areas(cut.V, cut.F)
    return Parts(cut, piece, float(area[specks].sum() / max(area[piece >= 0].sum(), 1e-300)))


def _solids(
    surface: Mesh, parts: Parts, sheets: Shell, options: Options
) -> tuple[list[tuple[Floats, Ints]], dict[str, Any]]:
    """Give the pieces their thickness, as files can hold it."""
    cut = parts.cut
    outer, D = (interpolate(X, surface.F, cut.vertex_face, cut.vertex_bary) for X in (sheets.outer, sheets.D))
    clearance = options.clearance if options.clearance_method == "solid" else 0.0
    made, facts = kerf(outer, cut.F, parts.piece_of_face, D, clearance)
    facts["discarded_volume_share"] += parts.discarded
    return [printable(V, F) for V, F in made], {**sheets.facts, **facts}
