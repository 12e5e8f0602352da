"""From a mesh to a puzzle, a line a stage."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any, Unpack

import numpy as np

from meshjig.check import ThinParts, judge_assembly
from meshjig.cut import cut_curves, merge_periodic
from meshjig.layout.congruent import LEAST_DIFFERENCE, clashes
from meshjig.layout.interlock import interlock
from meshjig.layout.layout import Layout, affected_pieces
from meshjig.layout.tiles import tile_layout
from meshjig.mesh.measure import area_vectors, sums
from meshjig.mesh.types import Floats, Ints, Mesh
from meshjig.options import OptionKeywords, Options
from meshjig.output.pictures.colours import colours
from meshjig.output.plates.material import bulk_of, material_of
from meshjig.output.texture import textures
from meshjig.pipeline.assembly_report import plan_of
from meshjig.pipeline.bodies import note_contacts
from meshjig.pipeline.cells_or_advice import cells_on
from meshjig.pipeline.debug_pictures import StagePictures
from meshjig.pipeline.extras import build_core, engrave_pieces, verify_core
from meshjig.pipeline.ground import surface_to_lay_out
from meshjig.pipeline.preflight import checked_options, refuse_hollow_piece, refuse_unknown_names
from meshjig.pipeline.prepare import clean_scan
from meshjig.pipeline.put_together import Together
from meshjig.pipeline.report import Made, assemble_report
from meshjig.pipeline.solids import beside_charts, leave_gaps, make_solids
from meshjig.pipeline.through import solid_parts, through_facts
from meshjig.pipeline.up import up_direction
from meshjig.pipeline.verify import verify
from meshjig.pipeline.work_mesh import work_atlas, work_mesh
from meshjig.puzzle import Curves, Piece, Puzzle
from meshjig.runtime.cores import use_cores
from meshjig.runtime.progress import Progress, Stages, peak_memory_mb
from meshjig.runtime.thresholds import SOLIDS_WORTH_A_CHILD
from meshjig.runtime.worker import Background

__all__ = ["make_puzzle"]


def make_puzzle(
    mesh: Any,
    *,
    progress: Progress | None = None,
    options: Options | None = None,
    debug_dir: str | os.PathLike[str] | None = None,
    **keywords: Unpack[OptionKeywords],
) -> Puzzle:
    """Turn a triangle mesh into a jigsaw puzzle of its surface.

    Parameters
    ----------
    mesh : path, trimesh.Trimesh, or (V, F)
    progress : callable, optional
        Called with a stage's name and "start" or "end".
    options : Options, optional
        In place of keywords.
    debug_dir : path, optional
        A folder that gets a picture of what each stage has made.
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
    options = checked_options(options, keywords)
    refuse_unknown_names(options)
    with use_cores(options.cores):
        return _make(mesh, options, Stages(progress), StagePictures(debug_dir))


def _make(mesh: Any, options: Options, stages: Stages, pictures: StagePictures) -> Puzzle:
    with stages("scan"):
        scan = clean_scan(mesh, options)
        up = pictures.up = up_direction(options.up, scan)
        surface, longest = work_mesh(scan.mesh, options)
        ground = surface_to_lay_out(surface, options)
        surface = ground.surface
    small = len(surface.F) < SOLIDS_WORTH_A_CHILD
    beside = Background(
        beside_charts, scan.mesh, surface, ground.thin is not None, options, alone=small, gently=True
    )
    try:
        if options.layout == "cells":
            ground, layout = cells_on(ground, options, stages, up)
            pictures.atlas(layout.atlas)
        else:
            with stages("charts"):
                atlas = work_atlas(scan, ground, longest, options)
            pictures.atlas(atlas)
            layout = tile_layout(atlas, options, stages)
        pictures.layout(layout)
        ground = ground.sparing(layout)
        refuse_hollow_piece(layout.cut.mesh, layout.piece_of_face, options)
        with stages("clearance"):
            parts = leave_gaps(layout, options)
        with stages("solid"):
            found = beside.result()
            sheets, crossing = found.sheets, found.crossing
            scan = replace(scan, facts=replace(scan.facts, self_crossings=found.n_crossings))
            pictures.shell(surface, sheets)
            made_solids = make_solids(layout, parts, ground, sheets, options, Together(up, crossing))
            layout, parts, pieces, kerf_facts, reaches, assembled = made_solids
        with stages("finish"):
            depths = np.where(reaches, ground.limit, 0.0)
            pieces, labels = engrave_pieces(pieces, surface, sheets, options, depths)
            taken = solid_parts(ground, sheets) if options.core else None
            core = build_core(surface, sheets, options, up, taken)
    except BaseException:
        beside.cancel()
        raise
    with stages("check"):
        locks = interlock(merge_periodic(layout.cut, layout.outlines), layout.knobs, layout.piece_of_face)
        notes = [*scan.facts.notes, *note_contacts(pieces, layout, options)]
        scan = replace(scan, facts=replace(scan.facts, notes=notes))
        affected = affected_pieces(crossing, ground.faces_of(layout), layout.piece_of_face)
        exempt = [pieces.names[i] for i in sorted(affected)]
        neighbours = locks.pairs[locks.faces_other(options.clearance, options.min_wall)]
        through = [name for name, reaching in zip(pieces.names, reaches, strict=True) if reaching]
        thin_parts = ThinParts(Mesh(sheets.outer, surface.F), through_pieces=through)
        pieces, verdict, mended = verify(replace(pieces, neighbours=neighbours), options, exempt, thin_parts)
        plan = plan_of(assembled, pieces, options)
        together = judge_assembly(pieces, plan, exempt) if plan else None
        core = verify_core(core, pieces, options, exempt)
        unique = clashes(layout, max(options.clearance, LEAST_DIFFERENCE))[1] if options.unique else None
        made = Made(
            options=options,
            scan=scan,
            up=up,
            layout=layout,
            on_surface=parts if options.clearance_method != "solid" else None,
            sheets=sheets.facts,
            kerf=kerf_facts,
            locks=locks,
            pieces=pieces,
            exempt=exempt,
            verdict=verdict,
            through=through_facts(ground, pieces, reaches),
            thin=found.thin,
            uncut=found.uncut,
            mended=mended,
            assembled=assembled,
            plan=plan,
            together=together,
            labels=labels,
            core=core,
            unique=unique,
        )
        report = assemble_report(made)
    dressed = _dressed(made, _outer_normals(layout, ground.labels(layout)))
    pictures.pieces(dressed)
    measured = {"timings_s": dict(stages.seconds), "peak_memory_mb": peak_memory_mb()}
    bulk = bulk_of(dressed).plus(bulk_of(core.parts if core else []))
    report |= measured | {"material": material_of(bulk, options.process)}
    curves = Curves(*cut_curves(layout.cut, layout.outlines)) if options.curves else Curves()
    return Puzzle(dressed, report, curves, core.parts if core else [])


def _dressed(made: Made, outward: Floats) -> list[Piece]:
    """Give pieces their colours, and the picture of the scan where it has one."""
    scan, options, pieces = made.scan, made.options, made.pieces
    t, drawn = options.thickness, 0.25 * options.thickness
    off = {"in": 0.0, "both": t / 2, "out": t}[options.side]
    solids = [(V, F) for V, F in pieces]
    tints = colours(len(pieces), made.locks.pairs)
    dressed = textures(solids, tints, scan.mesh, scan.source, scan.to_source, (off - drawn, off + drawn))
    return [
        Piece(
            name, V, F, tuple(tint), i + 1, texture=dressed[i] if dressed else None, outer_normal=outward[i]
        )
        for i, (name, (V, F), tint) in enumerate(zip(pieces.names, solids, tints.tolist(), strict=True))
    ]


def _outer_normals(layout: Layout, piece_of_face: Ints) -> Floats:
    """Give the area vector of every piece's outer sheet, without far sides, (p, 3), mm2."""
    kept, n = piece_of_face >= 0, layout.stitching.n_pieces
    A = area_vectors(layout.cut.V, layout.cut.F[kept]) / 2
    return np.stack([sums(piece_of_face[kept], A[:, k], n) for k in range(3)], 1)
