"""How a puzzle goes together, as the report has it."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from meshjig.check import AssemblyChecks, AssemblyPlan
from meshjig.mesh.arrays import Floats
from meshjig.mesh.pieces import Pieces
from meshjig.options import Options
from meshjig.output.report import Report
from meshjig.pipeline.put_together import Assembled

__all__ = ["assembly_report", "plan_of"]

_SHARP = 50.0  # degrees


def plan_of(assembled: Assembled | None, pieces: Pieces, options: Options) -> AssemblyPlan | None:
    """Give the plan that pieces, in the order of their numbers, are to be proved by."""
    if assembled is None:
        return None
    named = list(zip(pieces.names, assembled.motions, strict=True))
    return AssemblyPlan(
        pieces.names,
        {name: motion.way.tolist() for name, motion in named},
        {name: motion.shift.tolist() for name, motion in named if motion.shift.any()},
        options.give,
        {
            name: mm3
            for name, mm3 in zip(pieces.names, assembled.laid_out.tolist(), strict=True)
            if np.isfinite(mm3)
        },
    )


def assembly_report(assembled: Assembled, plan: AssemblyPlan, checks: AssemblyChecks) -> Report:
    """Give the report's "assembly"."""
    tilt = assembled.plan.tilt
    number = {name: i + 1 for i, name in enumerate(plan.order)}
    motions = {
        str(number[name]): {"axis": plan.way[name], "shift": plan.shift.get(name, [0, 0, 0]), "turn": None}
        for name in plan.order
    }
    return {
        "order": list(number.values()),
        "steps": [[i] for i in number.values()],
        "verified": checks.proved == checks.pieces,
        "motions": motions,
        "give_mm": plan.give,
        "islands": assembled.islands,
        "tilt": {
            "median": float(np.median(tilt)),
            "p95": float(np.percentile(tilt, 95)),
            "max": float(tilt.max()),
        },
        "wall_angle": _wall_angle(*assembled.angles),
        "plain_borders": assembled.plain,
        "joined_pieces": assembled.joined,
        "laid_out_mm3": {str(number[name]): mm3 for name, mm3 in plan.laid_out.items()},
        **asdict(checks),
    }


def _wall_angle(angle: Floats, length: Floats) -> dict[str, float | None]:
    """Give the least angle between wall and sheet, and the share of the borders' length below 50 degrees."""
    if not len(angle):
        return {"min": None, "under_50_share": None}
    steep = float(length[angle < _SHARP].sum() / max(length.sum(), 1e-300))
    return {"min": float(angle.min()), "under_50_share": steep}
