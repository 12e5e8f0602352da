"""Judge a puzzle by its files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from meshjig.check import AssemblyPlan, ThinParts, add_failures, judge, judge_assembly, judge_core
from meshjig.output.files.read_pieces import read_puzzle_files
from meshjig.output.report import Report, read_expectations, read_missing

__all__ = ["check_folder"]

_ASKED = ("neighbours", "thickness", "clearance", "min_wall", "exempt_pieces")


def check_folder(paths: Sequence[Path], asked_instead: Mapping[str, Any]) -> Report:
    """Judge finished pieces, and the core where there is one, by their files alone.

    Parameters
    ----------
    paths : see `meshjig.output.files.read_pieces.read_pieces`
    asked_instead : mapping
        Any of thickness, clearance, min_wall in mm, in place of what a report.json there says.

    Returns
    -------
    dict
        "checks", "names", "failures", "exempt": see `meshjig.check.Verdict`; among the failures also
        "missing", what a report lists and no file holds; "assembly", where there is a plan: see
        `meshjig.check.judge_assembly`; "core", where there is one: see `meshjig.check.judge_core`;
        "ok": bool.

    Raises
    ------
    InputError
        Nothing found, or a file that can't be read.
    """
    pieces, core, report = read_puzzle_files(paths)
    told = read_expectations(report, [name for name, _, _ in pieces])
    asked = {name: getattr(told, name) for name in _ASKED} | dict(asked_instead)
    # what is thin because the model is was measured with the least wall of then
    model_thin = told.model_thin if asked["min_wall"] == told.min_wall else {}
    verdict = judge(pieces, **asked, thin_parts=ThinParts(None, model_thin, told.through_pieces))
    result: Report = {"checks": verdict.checks, "names": verdict.named, "failures": verdict.failures}
    result["exempt"] = verdict.exempt
    if told.assembly is not None:
        proved, held = judge_assembly(pieces, AssemblyPlan(**told.assembly), asked["exempt_pieces"])
        result["assembly"] = asdict(proved)
        add_failures(result["failures"], held)
    missing = read_missing(report, [name for name, _, _ in (*pieces, *core)])
    if missing:
        result["failures"]["missing"] = missing
    if core:
        measured, broken = judge_core(
            core, pieces, clearance=asked["clearance"], exempt_pieces=asked["exempt_pieces"]
        )
        result["core"] = asdict(measured)
        add_failures(result["failures"], broken)
    return result | {"ok": not result["failures"]}
