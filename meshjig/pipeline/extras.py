"""Labels on the pieces and a core below them, where they are asked for."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from meshjig.check import add_failures, judge_core
from meshjig.extras import LETTERING, CoreShape, engrave, make_core
from meshjig.mesh.pieces import Pieces
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.output.pictures.view import guess_up
from meshjig.output.piece import Piece
from meshjig.output.plates.printers import parse_plate
from meshjig.solid import Shell
from meshjig.solid.printable import all_printable

__all__ = ["add_core", "core_of", "finished"]

CORE_WALLS = 2.0  # least walls of the process
CORE_COLOUR = (0.6, 0.6, 0.6)


def finished(pieces: Pieces, surface: Mesh, sheets: Shell, options: Options) -> tuple[Pieces, dict[str, Any]]:
    """Give pieces their labels, where they are asked for, and make them such that files can hold them.

    Parameters
    ----------
    pieces : Pieces
    surface : Mesh, what was offset
    sheets : Shell, its sheets
    options : Options

    Returns
    -------
    pieces : Pieces
    facts : dict, of the labels, see `meshjig.extras.engrave`; empty without
    """
    told: dict[str, Any] = {}
    solids = [(V, F) for V, F in pieces]
    if options.labels and all(len(F) for _, F in pieces):
        solids, facts = engrave(
            pieces,
            [str(i + 1) for i in range(len(pieces))],
            Mesh(sheets.outer, surface.F),
            sheets.D,
            LETTERING.get(options.process, LETTERING["fdm"]),
            min_wall=options.min_wall,
        )
        told = asdict(facts)
    return pieces.with_solids(all_printable(solids)), told


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
        CoreShape(
            clearance=options.clearance,
            wall=CORE_WALLS * options.min_wall,
            min_wall=options.min_wall,
            up=guess_up(surface.V, surface.F),
            plate=None if plate is None else (plate.width, plate.depth, plate.height),
        ),
    )
    sound = all_printable(parts)
    return [Piece(f"core_{i + 1}", V, F, CORE_COLOUR) for i, (V, F) in enumerate(sound)], asdict(facts)


def add_core(
    report: dict[str, Any],
    core: list[Piece],
    facts: dict[str, Any],
    pieces: Pieces,
) -> None:
    """Judge a core, and add it to the report of its puzzle: its facts, and the promises it breaks."""
    measured, broken = judge_core(
        [(part.name, part.V, part.F) for part in core],
        pieces,
        clearance=report["options"]["clearance"],
        exempt_pieces=report["exempt_pieces"],
    )
    report["core"] = facts | asdict(measured)
    add_failures(report["failures"], broken)
    report["ok"] &= not broken
