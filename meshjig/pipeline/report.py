"""The report of a puzzle: what went in, what was done, what was measured."""

from __future__ import annotations

from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from meshjig.check import Verdict, area_cv, area_error
from meshjig.layout.interlock import Interlock
from meshjig.layout.layout import Layout, Parts
from meshjig.layout.outer_gap import outer_gap
from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import face_areas, mesh_volume, sums
from meshjig.mesh.pieces import Pieces
from meshjig.options import Options
from meshjig.scan import Scan

__all__ = ["assemble_report", "meshjig_version", "told"]

MOST_AREA_ERROR = 1e-6
MOST_DISCARDED = 1e-3


def meshjig_version() -> str:
    """Give the installed version."""
    try:
        return version("meshjig")
    except PackageNotFoundError:
        return "unknown"


def told(facts: Any) -> dict[str, Any]:
    """Give the fields of a stage's facts as the report has them: those that are known."""
    return {key: fact for key, fact in asdict(facts).items() if fact is not None}


def assemble_report(
    options: Options,
    scan: Scan,
    layout: Layout,
    on_surface: Parts | None,
    locks: Interlock,
    verdict: Verdict,
    pieces: Pieces,
    solid_facts: dict[str, Any],
) -> dict[str, Any]:
    """Put together what report.json holds, but for timings and memory.

    Parameters
    ----------
    options, scan, layout, locks, verdict, pieces
        What the stages made.
    on_surface : Parts or None
        The surface as it was cut with the gap; None where the gap was taken from the solids.
    solid_facts : dict, what the solid stage says of itself
    """
    cut, mesh = layout.cut, layout.atlas.mesh
    n = layout.stitching.n_pieces
    areas = face_areas(cut.V, cut.F)
    area = sums(layout.piece_of_face, areas, n)
    gap = on_surface and outer_gap(
        on_surface.cut.V, on_surface.cut.F, on_surface.piece_of_face, options.clearance
    )
    least_neck = options.min_neck + options.clearance  # the gap takes half of it from either side
    checks = {
        **verdict.checks,
        "gap_outer_mm": gap,
        "area_error": area_error(areas, face_areas(mesh.V, mesh.F)),
        "discarded_volume_share": solid_facts["discarded_volume_share"],
        "interlocked_borders": locks.interlocked_borders(options.clearance),
        "interlocked_length": locks.interlocked_length(options.clearance),
        "head_neck": _head_neck(locks),
        "thin_necks": int((locks.neck < least_neck).sum()),
        "area_cv": area_cv(area),
    }
    failures = verdict.failures | _broken_as_a_whole(checks)
    return {
        "meshjig": meshjig_version(),
        "kind": "puzzle",
        "input": scan.facts.as_dict(),
        "options": options.model_dump(),
        "charts" if layout.cells is None else "cells": layout.atlas.facts
        | (asdict(layout.cells.facts) if layout.cells and layout.cells.facts else {}),
        "cut": asdict(cut.facts) if cut.facts else {},
        "stitching": told(layout.stitching.facts),
        "solid": solid_facts,
        "pieces": _pieces(n, area, pieces, locks, options),
        "checks": checks,
        "names": verdict.named | {"thin_necks": [pieces.names[i] for i in locks.thin_necked(least_neck)]},
        "failures": failures,
        "exempt": verdict.exempt,
        "ok": verdict.ok and len(failures) == len(verdict.failures),
    }


def _broken_as_a_whole(checks: dict[str, Any]) -> dict[str, list[str]]:
    """Name the promises about the whole puzzle that are broken; no single piece is to blame."""
    most = {"area_error": MOST_AREA_ERROR, "discarded_volume_share": MOST_DISCARDED}
    return {promise: [] for promise, limit in most.items() if checks[promise] > limit}


def _pieces(n: int, area: Floats, solids: Pieces, locks: Interlock, options: Options) -> list[dict[str, Any]]:
    neighbours: list[list[int]] = [[] for _ in range(n)]
    knobs = np.zeros(n, np.int64)
    facing = locks.faces_other(options.clearance, options.min_wall)
    pairs, counts = locks.pairs[facing].tolist(), locks.knobs_of_pair[facing].tolist()
    for (a, b), count in zip(pairs, counts, strict=True):
        neighbours[a].append(b + 1)
        neighbours[b].append(a + 1)
        knobs[[a, b]] += count
    return [
        {
            "id": i + 1,
            "area_mm2": float(area[i]),
            "volume_mm3": mesh_volume(*solids[i]),
            "neighbours": sorted(neighbours[i]),
            "knobs": int(knobs[i]),
        }
        for i in range(n)
    ]


def _head_neck(locks: Interlock) -> dict[str, float | None]:
    if not len(locks.neck):
        return {"min": None, "median": None}
    ratio = locks.head / np.maximum(locks.neck, 1e-9)
    return {"min": float(ratio.min()), "median": float(np.median(ratio))}
