"""What a maker may ask of a scan before it is cut into pieces, all in one record."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from meshjig.scan.source import Source

__all__ = ["Floor", "Keep", "Preparation", "UnitName"]

Keep = int | Literal["largest", "all"]
UnitName = Literal["mm", "cm", "m", "inch", "auto"]


@dataclass(frozen=True)
class Floor:
    """A plane below which a model is cut off."""

    height: float | None  # mm above the lowest point; None: a small share of the model's height
    up: Callable[[Source], int]  # gives the axis, 0, 1 or 2, along which that is
    open: bool = False  # whether the cut stays open
    stands: bool = False  # whether a cut that can't be closed all around is an error


@dataclass(frozen=True)
class Preparation:
    """What of a model is used, and how."""

    unit: UnitName = "auto"  # of the file's numbers; auto: what the file says, else what is plausible
    keep: Keep = "all"  # connected parts, by their area
    floor: Floor | None = None
    apart: float = 0.0  # mm, that bodies are drawn apart where they touch
    memory: float | None = None  # GB that reading and simplifying may take; None: no limit
