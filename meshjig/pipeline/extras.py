"""Labels on the pieces and a core below them, where they are asked for."""

from __future__ import annotations

from typing import Any

from meshjig.check import add_failures, judge_core
from meshjig.extras import LETTERING, engrave, make_core
from meshjig.mesh.types import Floats, Ints, Mesh
from meshjig.options import Options
from meshjig.output.pictures.view import guess_up
from meshjig.output.piece import Piece
from meshjig.output.plates.printers import parse_plate
from meshjig.solid import Shell
from meshjig.solid.printable import all_printable

__all__ = ["add_core", "core_of", "finished"]

Solid = tuple[Floats, Ints]

CORE_WALLS = 2.0  # least walls of the process
CORE_COLOUR = (0.6, 0.6, 0.6)


def finished(
    solids: list[Solid], surface: Mesh, sheets: Shell, options: Options
) -> tuple[list[Solid], dict[str, Any]]:
    """Give pieces their labels, where they are asked for, and make them such that files can hold them.

    Parameters
    ----------
    solids : list of (V, F), the pieces in order
    surface : Mesh, what was offset
    sheets : Shell, its sheets
    options : Options

    Returns
    -------
    solids : list of (V, F)
    facts : dict, of the labels, see `meshjig.extras.engrave`; empty without
    """
    facts: dict[str, Any] = {}
    if options.labels and all(len(F) for _, F in solids):
        solids, facts = engrave(
            solids,
            [str(i + 1) for i in range(len(solids))],
            Mesh(sheets.outer, surface.F),
            sheets.D,
            LETTERING.get(options.process, LETTERING["fdm"]),
            min_wall=options.min_wall,
        )
    return all_printable(solids), facts


def core_of(surface: Mesh, sheets: Shell, options: Options) -> tuple[list[Piece], dict[str, Any]]:
    """Make the body on which the puzzle is built up, in parts that fit the plate.

    Parameters
    ----------
    surface, sheets, options : as for `finished`

    Returns
    -------
    parts : list of Piece
    facts : dict, see `meshjig.extras.make_core`

    Raises
    ------
    SolidError
        The model has no room for a core.
    """
    plate = parse_plate(options.plate) if options.plate else None
    parts, facts = make_core(
        Mesh(sheets.outer, surface.F),
        sheets.D,
        options.clearance,
        wall=CORE_WALLS * options.min_wall,
        min_wall=options.min_wall,
        up=guess_up(surface.V, surface.F),
        plate=None if plate is None else (plate.width, plate.depth, plate.height),
    )
    sound = all_printable(parts)
    return [Piece(f"core_{i + 1}", V, F, CORE_COLOUR) for i, (V, F) in enumerate(sound)], facts


def add_core(
    report: dict[str, Any],
    core: list[Piece],
    facts: dict[str, Any],
    pieces: list[tuple[str, Floats, Ints]],
) -> None:
    """Judge a core, and add it to the report of its puzzle: its facts, and the promises it breaks."""
    measured, broken = judge_core(
        [(part.name, part.V, part.F) for part in core],
        pieces,
        clearance=report["options"]["clearance"],
        exempt_pieces=report["exempt_pieces"],
    )
    report["core"] = facts | measured
    add_failures(report["failures"], broken)
    report["ok"] &= not broken
