"""Printers by name, and how large their plates are."""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

import numpy as np

from meshjig.errors import OptionError, did_you_mean

__all__ = [
    "PRINTERS",
    "Nesting",
    "Plate",
    "estimate_plates",
    "parse_plate",
]


Nesting = Literal["fast", "tight"]  # how pieces are put on plates


class Plate(NamedTuple):
    """What a printer can hold, mm."""

    width: float
    depth: float
    height: float = float("inf")

    def __str__(self) -> str:
        known = [f"{side:g}" for side in self if side < float("inf")]
        return f"{' x '.join(known)} mm"


PRINTERS = {
    "bambu-a1": Plate(256, 256, 256),
    "bambu-a1-mini": Plate(180, 180, 180),
    "ender-3": Plate(220, 220, 250),
    "formlabs-3": Plate(145, 145, 185),
    "formlabs-4": Plate(200, 125, 210),
    "prusa-mini": Plate(180, 180, 180),
    "prusa-mk3": Plate(250, 210, 210),
    "prusa-mk4": Plate(250, 210, 220),
    "prusa-xl": Plate(360, 360, 360),
}

_SIZE = re.compile(r"(\d+\.?\d*)x(\d+\.?\d*)(?:x(\d+\.?\d*))?")


def parse_plate(text: str) -> Plate:
    """Read the size of a plate.

    Parameters
    ----------
    text : str
        A printer of `PRINTERS`, or WIDTHxDEPTH or WIDTHxDEPTHxHEIGHT in mm.

    Returns
    -------
    Plate
        Its height is infinite where none was given.

    Raises
    ------
    OptionError
        It is neither, or a side is zero.
    """
    name = text.strip().lower()
    if name in PRINTERS:
        return PRINTERS[name]
    size = _SIZE.fullmatch(name.replace(" ", ""))
    if size is None:
        near = did_you_mean(name, PRINTERS)
        hint = f"{near} give WIDTHxDEPTH in mm, such as 220x220, or one of {', '.join(PRINTERS)}".strip()
        raise OptionError(f"plate: {text!r} is not known", hint=hint, option="plate")
    plate = Plate(*(float(side) for side in size.groups() if side))
    if min(plate) <= 0:
        raise OptionError(f"plate: {text!r} has no area", hint="give WIDTHxDEPTH in mm", option="plate")
    return plate


_KNOBS = 1.2  # side of the rectangle around a piece, over the root of its area
_FILLED = 0.9  # share of a plate that rectangles with their gaps fill


def estimate_plates(n_pieces: int, area_mm2: float, plate: Plate, gap: float) -> int:
    """Estimate how many plates pieces of one size will need, before there are any.

    Parameters
    ----------
    n_pieces : int
    area_mm2 : float, of the whole surface
    plate : Plate
    gap : float, mm
    """
    side = _KNOBS * float(np.sqrt(area_mm2 / n_pieces)) + gap
    bed = (plate.width - gap) * (plate.depth - gap)
    return int(np.ceil(n_pieces * side**2 / (_FILLED * bed)))
