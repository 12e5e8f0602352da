"""What repair took away or joined, and what stays open, in sentences."""

from __future__ import annotations

import math

from meshjig.scan.fill import FilledHoles
from meshjig.scan.loss import Loss
from meshjig.scan.repair import Repairs

__all__ = ["open_borders_note", "repair_notes"]

_NAMED = 3  # open borders, the widest ones


def repair_notes(changes: Repairs) -> list[str]:
    """Say what a maker should know of how a mesh was repaired; no sentence where that is nothing."""
    notes = []
    lost = Loss(changes.lost_faces_share, changes.lost_area_share)
    if lost.much:
        why = [
            (changes.duplicate_faces, "faces that came twice"),
            (changes.null_faces, "faces without area"),
            (changes.dropped_components, "loose parts under a thousandth of the area"),
            (changes.cavities, "hollows inside the solid (--cavities keeps them)"),
        ]
        told = ", ".join(f"{n} {what}" for n, what in why if n)
        notes.append(
            f"repair took away {lost.faces:.0%} of the faces and {lost.area:.0%} of the area"
            + (f": {told}" if told else "")
        )
    if changes.hanging_vertices:
        notes.append(
            f"{changes.hanging_vertices} vertices lay on an edge of the face beside them, as between a fine "
            "and a coarse half: they are joined"
        )
    if changes.shared_walls:
        notes.append(
            f"{changes.shared_walls} faces lay inside, between two bodies: each body is now closed by its own"
        )
    return notes


def open_borders_note(facts: FilledHoles) -> list[str]:
    """Name the borders that stay open, and what would close them; no sentence where there are none."""
    if not facts.open:
        return []
    named = [
        f"{border.wide_mm:.3g} mm wide around ({', '.join(f'{round(x)}' for x in border.at)}) mm"
        for border in facts.open[:_NAMED]
    ]
    others = len(facts.open) - _NAMED
    more = f", and {others} smaller one{'s' if others > 1 else ''}" if others > 0 else ""
    least = [b.closed_from_mm for b in facts.open if b.closed_from_mm is not None]
    largest = max((x for x in least if x > facts.up_to_mm), default=None)
    if largest is not None:
        advice = f"--fill-holes {math.ceil(largest)} closes {'it' if len(facts.open) == 1 else 'them'}"
        if len(least) < len(facts.open):
            advice += ", but not the rims of small scraps"
    else:
        what = "they are rims" if len(facts.open) > 1 else "it is the rim"
        advice = f"{what} of scraps, or can't be closed cleanly: --keep largest leaves scraps out"
    s = "s" if len(facts.open) > 1 else ""
    stay = "stay" if s else "stays"
    return [f"{len(facts.open)} hole{s} {stay} open: {'; '.join(named)}{more}. Unless meant so: {advice}"]
