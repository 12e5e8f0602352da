"""What a puzzle will be, before it is made: pieces, their size, plates, material and hours."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.measure import face_areas, mesh_volume
from meshjig.mesh.mesh import Mesh
from meshjig.options import Options
from meshjig.output.plates.lay_out import GAP
from meshjig.output.plates.material import Bulk, bulk_of_core, bulk_of_surface, material_of
from meshjig.output.plates.printers import estimate_plates, parse_plate
from meshjig.output.report import Report
from meshjig.pipeline.extras import CORE_WALLS
from meshjig.pipeline.preflight import refuse_small_plate, refuse_too_small_pieces, refuse_unknown_names
from meshjig.pipeline.prepare import clean_scan

__all__ = ["plan_puzzle"]

COMMON_PLATE = "220x220"


def plan_puzzle(mesh: Any, options: Options) -> Report:
    """Say what `make_puzzle` would make of a mesh, from its surface alone.

    Parameters
    ----------
    mesh : path, trimesh.Trimesh, or (V, F)
    options : Options

    Returns
    -------
    dict
        "model": {"faces", "size_mm": [x, y, z], "units": str, "area_mm2"}; "layout"; "pieces": int;
        "piece_size_mm": edge of a square as large as a piece; "thickness_mm"; "clearance_mm";
        "plate": str; "plates": int; "material": {"volume_mm3", "grams", "hours"}, see
        `meshjig.output.plates.material.material_of`.

    Raises
    ------
    MeshjigError
        What `make_puzzle` would refuse before its work begins.
    """
    refuse_unknown_names(options)
    scan = clean_scan(mesh, options)
    surface = scan.mesh
    area = float(face_areas(surface.V, surface.F).sum())
    size = options.piece_size or float(np.sqrt(area / options.pieces))
    refuse_too_small_pieces(size, area, options)
    refuse_small_plate(size, options)
    n = max(1, round(area / size**2))
    plate = parse_plate(options.plate or COMMON_PLATE)
    return {
        "model": {
            "faces": len(surface.F),
            "size_mm": np.ptp(surface.V, axis=0).tolist(),
            "units": scan.facts.units,
            "area_mm2": area,
        },
        "layout": options.layout,
        "pieces": n,
        "piece_size_mm": size,
        "thickness_mm": options.thickness,
        "clearance_mm": options.clearance,
        "plate": str(plate),
        "plates": estimate_plates(n, area, plate, GAP),
        "material": material_of(_bulk(surface, area, size, options), options.process),
    }


def _bulk(surface: Mesh, area: float, size: float, options: Options) -> Bulk:
    """Tell what pieces of a size (mm), and the core where it is asked for, will be."""
    pieces = bulk_of_surface(area, options.thickness, size)
    if not options.core:
        return pieces
    return pieces.plus(bulk_of_core(area, abs(mesh_volume(*surface)), CORE_WALLS * options.min_wall))
