"""How much material and time printing takes, by volume."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from meshjig.mesh.measure import mesh_volume
from meshjig.output.piece import Piece
from meshjig.output.plates.printers import Plate

__all__ = ["RATES", "Rate", "estimate", "estimate_plates", "estimate_volume"]


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
