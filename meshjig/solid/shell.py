"""The shell: where the wall of a model lies, between an outer and an inner sheet."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from meshjig.errors import SolidError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import border_halfedges
from meshjig.solid.local_thickness import thinness
from meshjig.solid.offset_sheet import ShellFacts, offset_sheet
from meshjig.solid.untangle_sheet import FoldFacts

__all__ = ["Shell", "shell"]


@dataclass(frozen=True)
class Shell:
    """Two sheets over the same faces: outer, and outer + D, the inner one."""

    outer: Floats  # (n, 3), mm
    D: Floats  # (n, 3), mm
    facts: ShellFacts


def shell(
    V: Floats,
    F: Ints,
    thickness: float,
    *,
    side: Literal["in", "out", "both"] = "in",
    join: Literal["miter", "round"] = "miter",
) -> Shell:
    """Give a surface a thickness, to one side or half to each.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, oriented outward; may be open or have several components
    thickness : float, mm
    side : {"in", "out", "both"}
        The surface is the outer sheet, the inner one, or the middle.
    join : {"miter", "round"}
        Whether an offset crease stays sharp, or turns about the crease at an even distance.

    Returns
    -------
    Shell

    Raises
    ------
    SolidError
        The model is too thin for walls this thick, or is open and the join round.

    Notes
    -----
    Outward is inward on the mesh turned inside out. Both halves keep clear of the surface between them, so
    the sheets can't cross each other.
    """
    if join == "round" and len(border_halfedges(F)):
        raise SolidError(
            "the rounded join needs a closed model, since the offset of an open surface wraps around its rim",
            hint="use the mitered join, or close the model's holes",
        )
    walls = []
    share = 0.5 if side == "both" else 1.0
    if side != "out":
        walls.append((1.0, *offset_sheet(V, F, share * thickness, join)))
    if side != "in":
        walls.append((-1.0, *offset_sheet(V, F[:, ::-1], share * thickness, join)))
    D = sum((sign * step for sign, step, _, _ in walls), np.zeros_like(V))
    outer = V if side == "in" else V + walls[-1][1]
    distance = sum((reach for _, _, reach, _ in walls), np.zeros(len(V)))
    folds = FoldFacts(*(sum(counts) for counts in zip(*(wall[3].folds for wall in walls), strict=True)))
    facts = walls[0][3]._replace(folds=folds).told(side, join, thinness(V, F, distance, thickness))
    return Shell(outer, D, facts)
