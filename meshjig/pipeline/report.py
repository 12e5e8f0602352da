"""The report of a puzzle: what went in, what was done, what was measured."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from meshjig.check import AssemblyChecks, AssemblyPlan, Verdict, add_failures, area_cv, area_error
from meshjig.extras.engrave import LabelFacts
from meshjig.layout.congruent import UniqueFacts
from meshjig.layout.interlock import Interlock
from meshjig.layout.layout import Layout, Parts
from meshjig.layout.outer_gap import outer_gap
from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import face_areas, mesh_volume, sums
from meshjig.mesh.pieces import Pieces
from meshjig.options import Options
from meshjig.output.report import Report
from meshjig.pipeline.assembly_report import assembly_report
from meshjig.pipeline.exempt import exempt_note
from meshjig.pipeline.extras import Core
from meshjig.pipeline.notes import core_notes, lock_note, thin_notes
from meshjig.pipeline.put_together import Assembled
from meshjig.pipeline.through import ThroughFacts
from meshjig.pipeline.verify import Mended
from meshjig.runtime.version import meshjig_version
from meshjig.scan import Scan
from meshjig.scan.thin_share import ThinShare
from meshjig.solid.kerf import KerfFacts
from meshjig.solid.offset_sheet import ShellFacts

__all__ = ["Made", "assemble_report", "told"]

MOST_AREA_ERROR = 1e-6
MOST_DISCARDED = 1e-3


def told(facts: Any) -> Report:
    """Give the fields of a stage's facts as the report has them: those that are known."""
    return {key: fact for key, fact in asdict(facts).items() if fact is not None}


@dataclass(frozen=True)
class Made:
    """All that a puzzle's report is put together from: what went in, what stages made and measured."""

    options: Options
    scan: Scan
    up: Floats  # (3,), unit
    layout: Layout
    on_surface: Parts | None  # the surface as it was cut with the gap; None where the solids were
    sheets: ShellFacts
    kerf: KerfFacts
    locks: Interlock
    pieces: Pieces
    exempt: list[str]  # pieces that crossings of the model itself touch
    verdict: Verdict
    through: ThroughFacts
    thin: ThinShare  # what of the model is thinner than the least wall
    uncut: ThinShare | None  # what would be cut through, were it not for an option
    mended: Mended
    assembled: Assembled | None  # None where walls are along the normals
    plan: AssemblyPlan | None
    together: tuple[AssemblyChecks, dict[str, list[str]]] | None
    labels: LabelFacts | None
    core: Core | None
    unique: UniqueFacts | None

    @property
    def discarded_volume_share(self) -> float:
        """The share of the volume, and before it of the surface, that the gap has cut off."""
        on_surface = self.on_surface.discarded if self.on_surface else 0.0
        return self.kerf.discarded_volume_share + on_surface + self.mended.discarded_volume_share


def assemble_report(made: Made) -> Report:
    """Put together what report.json holds, but for timings, memory, and the files that come with it."""
    cut, locks, options = made.layout.cut, made.locks, made.options
    areas = face_areas(cut.V, cut.F)
    area = sums(made.layout.piece_of_face, areas, len(made.pieces))
    checks = _checks(made, areas, area)
    broken = _broken_as_a_whole(checks)
    failures = {promise: list(names) for promise, names in made.verdict.failures.items()} | broken
    add_failures(failures, made.core.failures if made.core else {})
    add_failures(failures, made.together[1] if made.together else {})
    thin = locks.thin_necked(_least_neck(options))
    facts = made.scan.facts.as_dict()
    report = {
        "meshjig": meshjig_version(),
        "kind": "puzzle",
        "input": {**facts, "notes": [*facts["notes"], *exempt_note(made.scan, options, made.verdict.exempt)]},
        "up": made.up.tolist(),
        "options": options.model_dump(),
        **_layout(made.layout),
        "cut": asdict(cut.facts) if cut.facts else {},
        "stitching": told(made.layout.stitching.facts),
        "solid": told(made.sheets)
        | told(made.kerf)
        | {"discarded_volume_share": made.discarded_volume_share, "dented": made.mended.dented},
        "pieces": _pieces(area, made.pieces, locks, options),
        "through": {**asdict(made.through), "model_thin": made.verdict.model_thin},
        "checks": checks,
        "names": made.verdict.named | {"thin_necks": [made.pieces.names[i] for i in thin]},
        "failures": failures,
        "exempt": made.verdict.exempt,
        "ok": not failures,
        "exempt_pieces": made.exempt,
        "notes": _notes(made),
    }
    if made.assembled and made.plan and made.together:
        report["assembly"] = assembly_report(made.assembled, made.plan, made.together[0])
    if options.labels:
        report["labels"] = asdict(made.labels) if made.labels else {}
    if made.core and made.core.checks:
        report["core"] = asdict(made.core.facts) | asdict(made.core.checks)
    if made.unique:
        report["unique"] = told(made.unique)
    return report


def _notes(made: Made) -> list[str]:
    """Give what a maker should know though no promise is broken, a sentence each."""
    locks = lock_note(made.layout, made.locks, made.options)
    core = core_notes(made.core.facts if made.core else None, made.scan.facts.components)
    return [*thin_notes(made.thin, made.options, made.uncut), *([] if locks is None else [locks]), *core]


def _layout(layout: Layout) -> Report:
    """Give the facts of the charts, or of the cells."""
    facts = dict(layout.atlas.facts)
    if layout.cells is None:
        return {"charts": facts}
    return {"cells": facts | (asdict(layout.cells.facts) if layout.cells.facts else {})}


def _least_neck(options: Options) -> float:
    return options.min_neck + options.clearance  # the gap takes half of it from either side


def _checks(made: Made, areas: Floats, area: Floats) -> Report:
    """Give what was measured of finished pieces, and of the surface that they were cut from."""
    options, locks, on_surface, mesh = made.options, made.locks, made.on_surface, made.layout.atlas.mesh
    gap = on_surface and outer_gap(
        on_surface.cut.V, on_surface.cut.F, on_surface.piece_of_face, options.clearance
    )
    return {
        **made.verdict.checks,
        "gap_outer_mm": gap,
        "area_error": area_error(areas, face_areas(mesh.V, mesh.F)),
        "discarded_volume_share": made.discarded_volume_share,
        "interlocked_borders": locks.interlocked_borders(options.clearance),
        "interlocked_length": locks.interlocked_length(options.clearance),
        "head_neck": _head_neck(locks),
        "thin_necks": int((locks.neck < _least_neck(options)).sum()),
        "area_cv": area_cv(area),
    }


def _broken_as_a_whole(checks: Report) -> dict[str, list[str]]:
    """Name the promises about the whole puzzle that are broken; no single piece is to blame."""
    most = {"area_error": MOST_AREA_ERROR, "discarded_volume_share": MOST_DISCARDED}
    return {promise: [] for promise, limit in most.items() if checks[promise] > limit}


def _pieces(area: Floats, pieces: Pieces, locks: Interlock, options: Options) -> list[Report]:
    """Give a row for every piece."""
    n = len(pieces)
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
            "volume_mm3": mesh_volume(*pieces[i]),
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
