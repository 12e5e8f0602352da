"""What a maker should know of a finished puzzle though no promise is broken, a sentence each."""

from __future__ import annotations

import math

import numpy as np

from meshjig.extras.core import CoreFacts
from meshjig.layout.interlock import Interlock
from meshjig.layout.layout import Layout
from meshjig.layout.lock_advice import FEW_LOCKED, LockAdvice, lock_advice
from meshjig.mesh.mesh import Mesh
from meshjig.options import PROCESSES, Options
from meshjig.pipeline.ground import limit_asked, why_not_through
from meshjig.scan.thin_share import ThinShare, thin_shares

__all__ = ["core_notes", "lock_note", "thin_notes", "thin_places"]

_LEAST_PIECES = 4  # as few are no puzzle any more
_TILES = 1.5  # times as large, most tiles lock that hardly did
_SPARE = 1.05  # of what was found to do, before it is rounded up


def lock_note(layout: Layout, locks: Interlock, options: Options) -> str | None:
    """Say so where less than half of the border length is locked, and what would change it.

    Parameters
    ----------
    layout : Layout
    locks : Interlock, its borders
    options : Options

    Returns
    -------
    str, or None where enough is locked, or nothing borders on anything
    """
    share = locks.interlocked_length(options.clearance)
    if share is None or share >= FEW_LOCKED:
        return None
    held = f"only {100 * share:.0f} % of the border length is locked, so pieces hardly hold each other"
    mesh, n = layout.atlas.mesh, int(layout.piece_of_face.max(initial=0)) + 1
    size, extent = float(np.sqrt(mesh.areas.sum() / n)), float(np.ptp(mesh.V, axis=0).max())
    if layout.cells is None:
        ways = _ways(LockAdvice(_TILES, None), extent, size, options)
        return f"{held}: tiles lock where they are larger; try {' or '.join(ways)}"
    knobs = max(options.knob_size, 1.0)
    least = options.min_neck + options.clearance
    advice = lock_advice(layout.atlas, size=size, knob_size=knobs, least_neck=least, seed=options.seed)
    ways = _ways(advice, extent, size, options)
    if not ways:
        return f"{held}: no knob that was tried has room on these cells"
    wide = f"knobs with necks of {options.min_neck:g} mm find no room on pieces of {size:.2g} mm"
    first = "--knob-size 1" if knobs > options.knob_size else ""
    if advice.larger == 1.0:
        return f"{held}: {wide}; try {first}"
    return f"{held}: {wide}; try {first}{' with ' if first else ''}{' or '.join(ways)}"


def core_notes(core: CoreFacts | None, bodies: int) -> list[str]:
    """Say so where a core is not hollow everywhere, or is in one of several bodies only."""
    if core is None:
        return []
    notes = []
    if bodies > 1:
        notes.append(
            f"the core is made for the largest of {bodies} bodies only: make the others alone where they are"
            " to have one"
        )
    if core.filled_mm3:
        solid = f"{core.filled_mm3 / 1000:.0f} cm3 of the core are solid"
        notes.append(f"{solid}, since no hollow with a drain could be made there")
    return notes


def thin_places(mesh: Mesh, options: Options) -> tuple[ThinShare, ThinShare | None]:
    """Say what of a model is thinner than the least wall, and what is not cut through because of an option.

    Parameters
    ----------
    mesh : Mesh, mm
    options : Options

    Returns
    -------
    thin : ThinShare
    uncut : ThinShare, or None where no option keeps anything from being cut through
    """
    limits = [options.min_wall, *([limit_asked(options)] if why_not_through(options) else [])]
    thin, *uncut = thin_shares(mesh, limits)
    return thin, uncut[0] if uncut else None


def thin_notes(thin: ThinShare, options: Options, uncut: ThinShare | None = None) -> list[str]:
    """Say so where the model is thinner than the least wall, and which size cures it; or walls are to be.

    And where thin parts are not cut through because of another option.

    Parameters
    ----------
    thin : ThinShare, of the model and the least wall
    options : Options
    uncut : ThinShare, of the model and the limit below which it would be cut through; None where it is
    """
    notes = []
    if options.thickness < options.min_wall:
        notes.append(
            f"walls of {options.thickness:g} mm were asked for, thinner than the {options.min_wall:g} mm of "
            "--min-wall: use a larger --thickness, or a smaller --min-wall where the printer can make it"
        )
    if thin.thinnest_mm is not None and thin.thinnest_at is not None:
        where = ", ".join(f"{x:.0f}" for x in thin.thinnest_at)
        notes.append(
            f"{100 * thin.area_share:.2g} % of the model is thinner than {thin.thinner_than_mm:g} mm, down "
            f"to {thin.thinnest_mm:.2g} mm around ({where}) mm, and pieces can't be thicker than it is: "
            f"--size {_rounded_up(thin.none_from_size_mm):g} makes it thick enough"
        )
    if uncut is not None and uncut.thinnest_mm is not None:
        notes.append(
            f"{100 * uncut.area_share:.2g} % of the model is thinner than {uncut.thinner_than_mm:g} mm, "
            f"but is not cut through: {why_not_through(options)}"
        )
    return notes


def _ways(advice: LockAdvice, extent: float, size: float, options: Options) -> list[str]:
    """List the options of which each by itself would lock most borders."""
    ways = []
    if advice.larger is not None:
        larger = _SPARE * advice.larger
        if options.piece_size is not None:
            ways.append(f"--piece-size {_rounded_up(larger * size):g}")
        else:
            ways.append(f"--size {_rounded_up(larger * extent):g}")
            fewer = int(options.pieces / larger**2)
            ways += [f"--pieces {fewer}"] if fewer >= _LEAST_PIECES else []
        ways += _finer(options.min_neck, (options.min_neck + options.clearance) / larger, options)
    if advice.knob_size is not None:
        ways.append(f"--knob-size {advice.knob_size:g}")
    return ways


def _finer(neck: float, most: float, options: Options) -> list[str]:
    """Name the process whose necks and gap together are narrow enough, where one was used as it is."""
    preset = PROCESSES.get(options.process)
    if preset is None or preset["min_neck"] != neck or preset["clearance"] != options.clearance:
        narrow = math.floor(10 * (most - options.clearance)) / 10
        return [f"--min-neck {narrow:g} where the printer can make it"] if narrow > 0 else []
    fine = [name for name, values in PROCESSES.items() if values["min_neck"] + values["clearance"] <= most]
    return [f"--process {fine[0]} where that is the printer"] if fine else []


def _rounded_up(value: float) -> float:
    """Round up to two digits."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.ceil(value / step) * step
