"""What a puzzle will be, before it is cut: pieces, their size, plates, core, material and hours."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.cells import grow_cells
from meshjig.errors import CutError
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.output.plates.lay_out import GAP
from meshjig.output.plates.material import bulk_of, bulk_of_surface, material_of
from meshjig.output.plates.printers import estimate_plates, parse_plate
from meshjig.output.report import Report
from meshjig.pipeline.cells_or_advice import refuse_cells
from meshjig.pipeline.extras import build_core
from meshjig.pipeline.ground import Ground, surface_to_lay_out
from meshjig.pipeline.notes import core_notes, thin_notes, thin_places
from meshjig.pipeline.preflight import refuse_hollow_piece, refuse_unknown_names
from meshjig.pipeline.prepare import clean_scan
from meshjig.pipeline.through import solid_parts
from meshjig.pipeline.up import up_direction
from meshjig.pipeline.work_mesh import work_atlas, work_mesh
from meshjig.solid import Shell, shell

__all__ = ["plan_puzzle"]

COMMON_PLATE = "220x220"


def plan_puzzle(mesh: Any, options: Options) -> Report:
    """Say what `make_puzzle` would make of a mesh, after all that it does before anything is cut.

    Parameters
    ----------
    mesh : path, trimesh.Trimesh, or (V, F)
    options : Options

    Returns
    -------
    dict
        "model": {"faces", "size_mm": [x, y, z], "units", "area_mm2"}; "layout"; "pieces": int, cells as
        they grow, tiles as asked for; "piece_size_mm": edge of a square as large as a piece;
        "thickness_mm"; "clearance_mm"; "core": {"parts", "volume_mm3"} where there is one; "plate": str;
        "plates": int, those of a core too; "material": {"volume_mm3", "grams", "hours"}, of pieces and
        core, see `meshjig.output.plates.material.material_of`.

    Raises
    ------
    MeshjigError
        What `make_puzzle` would refuse before it cuts: sizes, names, walls and cores without room, cells
        that are no discs, charts that can't be made.
    """
    refuse_unknown_names(options)
    scan = clean_scan(mesh, options)
    surface, longest = work_mesh(scan.mesh, options)
    ground = surface_to_lay_out(surface, options)
    surface = ground.surface
    area, laid_out = float(surface.areas.sum()), float(ground.mesh.areas.sum())
    n = max(1, round(laid_out / options.piece_size**2)) if options.piece_size else options.pieces
    if options.layout == "cells":
        n = _cells(ground, n, options)
    else:
        work_atlas(scan, ground, longest, options)
    sheets = shell(
        surface.V,
        surface.F,
        options.thickness,
        side=options.side,
        join=options.join,
        crowded=ground.thin is not None,
    )
    taken = solid_parts(ground, sheets) if options.core else None
    core = build_core(surface, sheets, options, up_direction(options.up, scan), taken)
    size = float(np.sqrt(laid_out / n))
    bulk = bulk_of_surface(area, _wall(surface, sheets), size).plus(bulk_of(core.parts if core else []))
    plate = parse_plate(options.plate or COMMON_PLATE)
    thin, uncut = thin_places(scan.mesh, options)
    facts = {} if core is None else {"core": {"parts": core.facts.parts, "volume_mm3": core.facts.volume_mm3}}
    return {
        "model": {
            "faces": len(scan.mesh.F),
            "size_mm": np.ptp(surface.V, axis=0).tolist(),
            "units": scan.facts.units,
            "area_mm2": area,
        },
        "layout": options.layout,
        "pieces": n,
        "piece_size_mm": size,
        "thickness_mm": options.thickness,
        "clearance_mm": options.clearance,
        **facts,
        "plate": str(plate),
        "plates": min(estimate_plates(n, laid_out, plate, GAP), n) + (core.facts.parts if core else 0),
        "material": material_of(bulk, options.process),
        "notes": [
            *scan.facts.notes,
            *thin_notes(thin, options, uncut),
            *core_notes(core.facts if core else None, scan.facts.components),
        ],
    }


def _cells(ground: Ground, n: int, options: Options) -> int:
    """Give the number of cells that a surface has."""
    try:
        cells = grow_cells(
            ground.mesh, n, seed=options.seed, style=options.style, crease_aware=options.crease_aware
        )
    except CutError as error:
        if ground.mesh is not ground.surface:
            return _cells(ground.whole(), n, options)
        raise refuse_cells(error, ground.mesh, options) from None
    refuse_hollow_piece(cells.mesh, cells.cell, options)
    return cells.n_cells


def _wall(surface: Mesh, sheets: Shell) -> float:
    """Give the volume between two sheets over the area of the surface, mm."""
    half = Mesh(sheets.outer + sheets.D / 2, surface.F)
    depth = np.linalg.norm(sheets.D, axis=1)[surface.F].mean(axis=1)
    return float((face_areas(half.V, half.F) * depth).sum() / surface.areas.sum())
