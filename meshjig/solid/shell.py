"""The shell: where the wall of a model lies, between an outer and an inner sheet."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from meshjig.errors import SolidError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import border_halfedges
from meshjig.solid.local_thickness import TooThick, thinness
from meshjig.solid.offset_sheet import SheetFacts, ShellFacts, offset_sheet
from meshjig.solid.untangle_sheet import FoldFacts

__all__ = ["Shell", "shell"]


Side = Literal["in", "out", "both"]
Join = Literal["miter", "round"]

_TRIES = 7  # thinner walls that are tried before none are advised
_THINNEST = 0.3  # mm; what is thinner is no wall
_MOST_THIN = 1 / 3  # share of the area that may be thinner, where a thickness is said to work
_LESS = 0.75  # of a thickness at which sheets still cross


class _Wall(NamedTuple):
    sign: float  # 1 inward, -1 outward
    D: Floats  # (n, 3), mm
    distance: Floats  # (n,), mm
    facts: SheetFacts


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
    side: Side = "in",
    join: Join = "miter",
    crowded: bool = False,
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
    crowded : bool
        Whether the model may be too thin for two such walls anywhere, as where thin parts are cut through.

    Returns
    -------
    Shell

    Raises
    ------
    SolidError
        The model is too thin for walls this thick, or is open and the join round. The sentence names a
        thickness that was tried and works, where there is one.

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
    try:
        walls = _walls(V, F, thickness, side, join, crowded)
    except TooThick as error:
        raise _advised(V, F, thickness, side, join, error) from None
    D = sum((sign * step for sign, step, _, _ in walls), np.zeros_like(V))
    outer = V if side == "in" else V + walls[-1][1]
    distance = sum((reach for _, _, reach, _ in walls), np.zeros(len(V)))
    folds = FoldFacts(*(sum(counts) for counts in zip(*(wall.facts.folds for wall in walls), strict=True)))
    facts = walls[0].facts._replace(folds=folds).told(side, join, thinness(V, F, distance, thickness))
    return Shell(outer, D, facts)


def _walls(
    V: Floats, F: Ints, thickness: float, side: Side, join: Join, crowded: bool = False
) -> list[_Wall]:
    """Lay a sheet to each side that has one."""
    walls = []
    share = 0.5 if side == "both" else 1.0
    if side != "out":
        walls.append(_Wall(1.0, *offset_sheet(V, F, share * thickness, join, crowded)))
    if side != "in":
        walls.append(_Wall(-1.0, *offset_sheet(V, F[:, ::-1], share * thickness, join, crowded)))
    return walls


def _advised(V: Floats, F: Ints, thickness: float, side: Side, join: Join, error: TooThick) -> SolidError:
    """Say which thickness does, after trying it: some models have no room for any that is tried."""
    share, largest = 0.5 if side == "both" else 1.0, error.largest
    says = f"walls of {thickness:g} mm are too thick for this model"
    for _ in range(_TRIES):
        thinner = largest / share
        if thinner < _THINNEST:
            break
        try:
            walls = _walls(V, F, thinner, side, join)
            thick = thinness(V, F, walls[0].distance, share * thinner).thin_area_share <= _MOST_THIN
            if thick and not any(wall.facts.folds.crossings_left for wall in walls):
                return SolidError(says, hint=f"a thickness of {thinner:.3g} mm works at this size")
            largest = _LESS * largest
        except TooThick as again:
            largest = again.largest
    return SolidError(
        f"{says}, and no thinner ones were found that surely work: most of it is thinner than walls can be,"
        " or touches itself",
        hint="make it larger (--size), or give it another shape in a mesh editor, such as MeshLab",
    )
