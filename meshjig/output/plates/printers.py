"""Printers by name, and how large their plates are."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Literal, NamedTuple

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.measure import mesh_volume
from meshjig.output.piece import Piece

__all__ = [
    "PRINTERS",
    "RATES",
    "Nesting",
    "Plate",
    "Rate",
    "estimate",
    "estimate_plates",
    "estimate_volume",
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
        raise OptionError(
            f"plate: {text!r} is not known", hint=f"give WIDTHxDEPTH in mm, or one of {', '.join(PRINTERS)}"
        )
    plate = Plate(*(float(side) for side in size.groups() if side))
    if min(plate) <= 0:
        raise OptionError(f"plate: {text!r} has no area", hint="give WIDTHxDEPTH in mm")
    return plate


class Rate(NamedTuple):
    """What a process needs for a volume of thin, curved pieces that lie on the plate."""

    density: float  # g/cm3
    used: float  # volume of all that is printed, supports included, over that of the pieces
    speed: float | None  # cm3 of pieces an hour, supports included; None where nothing is printed


RATES = {
    # PLA. Sliced by PrusaSlicer with 0.2 mm layers: 3.0 cm3/h at 60 mm/s, 4.9 at 170 mm/s.
    "fdm": Rate(1.24, 2.3, 4.0),
    # Standard resins, 0.1 mm layers, a full plate; thin props.
    "sla": Rate(1.15, 1.3, 12.0),
    # Acrylic photopolymer; whatever hangs over rests on gel.
    "polyjet": Rate(1.18, 2.0, 15.0),
    # EVA, which is cut and not printed.
    "foam": Rate(0.1, 1.0, None),
}

_KNOBS = 1.2  # side of the rectangle around a piece, over the root of its area
_FILLED = 0.9  # share of a plate that rectangles with their gaps fill


def estimate(pieces: Iterable[Piece], process: str) -> dict[str, float | None]:
    """Estimate what finished pieces take to print.

    Parameters
    ----------
    pieces : Piece, closed
    process : str
        One of `RATES`; any other is taken to be as fdm.

    Returns
    -------
    dict
        volume_mm3, of the pieces; grams, of all that is printed, with supports; hours, or None where
        nothing is printed. Good to a factor of two: printers and settings differ as much.
    """
    return _by_volume(sum(mesh_volume(piece.V, piece.F) for piece in pieces), process)


def estimate_volume(area_mm2: float, thickness: float, process: str) -> dict[str, float | None]:
    """Estimate the same before there are pieces, from the area of the surface and their thickness, mm."""
    return _by_volume(area_mm2 * thickness, process)


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


def _by_volume(volume: float, process: str) -> dict[str, float | None]:
    rate = RATES.get(process, RATES["fdm"])
    cm3 = float(volume) / 1000
    return {
        "volume_mm3": float(volume),
        "grams": cm3 * rate.used * rate.density,
        "hours": cm3 / rate.speed if rate.speed else None,
    }
