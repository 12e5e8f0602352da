"""The report of a puzzle: what went in, what was done, what was measured."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from meshjig.check import Verdict
from meshjig.check.interlock import Interlock
from meshjig.measure import face_areas, mesh_volume, sums
from meshjig.options import Options
from meshjig.progress import Stages, peak_memory_mb
from meshjig.types import Atlas, CutMesh, Floats, Ints, Scan, Stitching

__all__ = ["assemble_report", "meshjig_version"]


def meshjig_version() -> str:
    """Give the installed version."""
    try:
        return version("meshjig")
    except PackageNotFoundError:
        return "unknown"


def assemble_report(
    options: Options,
    scan: Scan,
    atlas: Atlas,
    cut: CutMesh,
    stitching: Stitching,
    piece_of_face: Ints,
    locks: Interlock,
    verdict: Verdict,
    solids: list[tuple[Floats, Ints]],
    solid_facts: dict[str, Any],
    gap_outer: dict[str, Any],
    discarded: float,
    stages: Stages,
) -> dict[str, Any]:
    """Put together what report.json holds.

    Parameters
    ----------
    options, scan, atlas, cut, stitching, locks, verdict, solids
        What the stages made.
    piece_of_face : (m,) int64, for the faces of cut
    solid_facts : dict, what the solid stage says of itself
    gap_outer : dict, the gap on the outer surface
    discarded : float, share of the area that the gap cut off from its piece
    stages : Stages
    """
    n = stitching.n_pieces
    areas = face_areas(cut.V, cut.F)
    area = sums(piece_of_face, areas, n)
    mesh = atlas.mesh
    surface = face_areas(mesh.V, mesh.F).sum()
    checks = {
        **verdict.checks,
        "gap_outer_mm": gap_outer,
        "area_error": float(abs(areas.sum() - surface) / surface),
        "discarded_volume_share": discarded,
        "interlocked_borders": locks.interlocked_borders,
        "interlocked_length": locks.interlocked_length,
        "head_neck": _head_neck(locks),
        "thin_necks": int((locks.neck < options.min_neck).sum()),
        "area_cv": float(area.std() / area.mean()),
    }
    return {
        "meshjig": meshjig_version(),
        "input": scan.facts,
        "options": options.model_dump(),
        "charts": atlas.facts,
        "cut": cut.facts,
        "stitching": stitching.facts,
        "solid": solid_facts,
        "pieces": _pieces(n, area, solids, locks),
        "checks": checks,
        "failures": verdict.failures,
        "timings_s": dict(stages.seconds),
        "peak_memory_mb": peak_memory_mb(),
        "ok": verdict.ok,
    }


def _pieces(
    n: int, area: Floats, solids: list[tuple[Floats, Ints]], locks: Interlock
) -> list[dict[str, Any]]:
    neighbours: list[list[int]] = [[] for _ in range(n)]
    knobs = np.zeros(n, np.int64)
    for (a, b), count in zip(locks.pairs.tolist(), locks.knobs_of_pair.tolist(), strict=True):
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
