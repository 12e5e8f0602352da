"""Labels on the pieces and a core below them, where they are asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from meshjig.check import CoreChecks, judge_core
from meshjig.extras import LETTERING, CoreShape, engrave, label_grounds, make_core
from meshjig.extras.core import CoreFacts
from meshjig.extras.engrave import LabelFacts
from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.pieces import Pieces
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.output.piece import Piece
from meshjig.output.plates.lay_out import GAP
from meshjig.output.plates.printers import parse_plate
from meshjig.solid import Shell
from meshjig.solid.keep_clear import keep_clear
from meshjig.solid.printable import all_printable

__all__ = ["Core", "build_core", "engrave_pieces", "verify_core"]

CORE_WALLS = 2.0  # least walls of the process
CORE_COLOUR = (0.6, 0.6, 0.6)


@dataclass(frozen=True)
class Core:
    """The body that a puzzle is built up on, and what was found of it."""

    parts: list[Piece]
    facts: CoreFacts
    checks: CoreChecks | None = None  # None until it is judged
    failures: Mapping[str, list[str]] = field(default_factory=dict)  # promises, and the names that break them


def engrave_pieces(
    pieces: Pieces, surface: Mesh, sheets: Shell, options: Options, reach: Floats | None = None
) -> tuple[Pieces, LabelFacts | None]:
    """Give pieces their labels, where they are asked for, and make them such that files can hold them.

    Parameters
    ----------
    pieces : Pieces
    surface : Mesh, what was offset
    sheets : Shell, its sheets
    options : Options
    reach : (p,) float64, mm, optional
        How thick the thin parts are at most that each piece reaches through; 0 for none.

    Returns
    -------
    pieces : Pieces
    facts : LabelFacts, or None without labels
    """
    facts: LabelFacts | None = None
    solids = [(V, F) for V, F in pieces]
    if options.labels and all(len(F) for _, F in pieces):
        solids, facts = engrave(
            pieces,
            [str(i + 1) for i in range(len(pieces))],
            label_grounds(solids, Mesh(sheets.outer, surface.F), sheets.D, reach),
            LETTERING.get(options.process, LETTERING["fdm"]),
            min_wall=options.min_wall,
        )
    return pieces.with_solids(all_printable(solids)), facts


def build_core(
    surface: Mesh, sheets: Shell, options: Options, up: Floats, taken: Mesh | None = None
) -> Core | None:
    """Make the body on which the puzzle is built up, where it is asked for, in parts that fit the plate.

    Parameters
    ----------
    surface, sheets, options : as for `engrave_pieces`
    up : (3,) float64, unit
    taken : Mesh, optional
        What lies between both sides of parts that are cut through.

    Raises
    ------
    SolidError
        The model has no room for a core.
    """
    if not options.core:
        return None
    plate = parse_plate(options.plate) if options.plate else None
    parts, facts = make_core(
        Mesh(sheets.outer, surface.F),
        sheets.D,
        CoreShape(
            clearance=options.clearance,
            wall=CORE_WALLS * options.min_wall,
            min_wall=options.min_wall,
            up=up,
            plate=None if plate is None else (plate.width - 2 * GAP, plate.depth - 2 * GAP, plate.height),
        ),
        taken,
    )
    sound = all_printable(parts)
    return Core([Piece(f"core_{i + 1}", V, F, CORE_COLOUR) for i, (V, F) in enumerate(sound)], facts)


def verify_core(core: Core | None, pieces: Pieces, options: Options, exempt: Sequence[str]) -> Core | None:
    """Judge a core, where there is one, beside the pieces; it yields where they are too near."""
    if core is None:
        return None
    core = _judged(core, pieces, options, exempt)
    broken = {name for promise in ("gap_mm", "overlap_mm3") for name in core.failures.get(promise, ())}
    if not broken:
        return core
    solid = dict(zip(pieces.names, pieces.solids, strict=True))
    beside = [solid[name] for name in pieces.names if name in broken]
    kept = [
        keep_clear(Mesh(part.V, part.F), beside, options.clearance) if part.name in broken else part
        for part in core.parts
    ]
    parts = all_printable([(part.V, part.F) for part in kept])
    core = replace(
        core,
        parts=[replace(old, V=V, F=F) for old, (V, F) in zip(core.parts, parts, strict=True)],
        facts=replace(core.facts, volume_mm3=sum(mesh_volume(V, F) for V, F in parts)),
    )
    return _judged(core, pieces, options, exempt)


def _judged(core: Core, pieces: Pieces, options: Options, exempt: Sequence[str]) -> Core:
    checks, failures = judge_core(
        [(part.name, part.V, part.F) for part in core.parts],
        pieces,
        clearance=options.clearance,
        exempt_pieces=exempt,
    )
    return replace(core, checks=checks, failures=failures)
