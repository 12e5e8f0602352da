"""How much material puzzles take to print, and how many hours."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from meshjig.mesh.measure import face_areas, mesh_volume
from meshjig.output.piece import Piece
from meshjig.output.plates.pose import lying_pose
from meshjig.output.plates.support import support_under

__all__ = ["RATES", "Bulk", "Material", "Rate", "bulk_of", "bulk_of_surface", "material_of"]

Material = dict[str, float | None]


class Rate(NamedTuple):
    """What a process needs for a volume of thin, curved pieces that lie on the plate."""

    density: float  # g/cm3
    used: float  # volume of all that is printed, supports included, over that of the pieces
    speed: float | None  # cm3 of pieces an hour, supports included; None where nothing is printed


RATES = {
    # Standard resins, 0.1 mm layers, a full plate; thin props.
    "sla": Rate(1.15, 1.3, 12.0),
    # Acrylic photopolymer; whatever hangs over rests on gel.
    "polyjet": Rate(1.18, 2.0, 15.0),
    # EVA, which is cut and not printed.
    "foam": Rate(0.1, 1.0, None),
}

# Any other process is taken to be fdm. Fitted to what PrusaSlicer 2.5 says of thirteen plates of bunny, spot,
# fandisk, a vase and a duck, 2 and 3 mm thick: 0.4 mm nozzle, 0.2 mm layers, 15 % infill, supports, PLA, its
# own speeds.
_PLA = 1.24  # g/cm3
_FOOT = 2.4  # mm of material under what hangs over: dense layers below it, walls of narrow supports
_SPARSE = 0.16  # share of a support's volume that is material
_BEAD = 18.5  # cm3 an hour at full speed: 60 mm/s, 0.4 mm wide and 0.2 mm high
_WALLS = 70.0  # cm2 of surface an hour: slow outer walls and ways between

_SAMPLE = 24  # pieces that stand for all
_RIM = 8.0  # length of a piece's border with its knobs, over the side of a square as large
_HANGS = 0.22  # share of the surface of pieces that hangs over
_SAG = 0.16  # height of supports below pieces, over the side of a square as large


class Bulk(NamedTuple):
    """What is to be printed, as it lies on the plate; of several things it adds up."""

    volume: float  # mm3
    area: float  # mm2, of all sides
    overhang: float  # mm2, the shadow of what needs support
    support: float  # mm3, the room that supports fill

    def plus(self, other: Bulk, times: float = 1.0) -> Bulk:
        """Give both together, the other a number of times."""
        return Bulk(*(a + times * b for a, b in zip(self, other, strict=True)))


NOTHING = Bulk(0.0, 0.0, 0.0, 0.0)


def bulk_of(pieces: Sequence[Piece]) -> Bulk:
    """Measure pieces laid on a plate; where there are many, the supports of a few stand for those of all.

    Parameters
    ----------
    pieces : sequence of Piece, closed

    Returns
    -------
    Bulk
    """
    volume = sum(mesh_volume(piece.V, piece.F) for piece in pieces)
    some = pieces[:: -(-len(pieces) // _SAMPLE) or 1]
    found = NOTHING
    for piece in some:
        R = lying_pose(piece.V, piece.F, piece.outer_normal).R
        support = support_under(piece.V @ R.T, piece.F)
        area = float(face_areas(piece.V, piece.F).sum())
        found = found.plus(Bulk(mesh_volume(piece.V, piece.F), area, *support))
    return NOTHING.plus(found, float(volume) / max(found.volume, 1e-9))


def bulk_of_surface(area: float, thickness: float, piece_size: float) -> Bulk:
    """Tell the same of pieces before there are any.

    Parameters
    ----------
    area : float, of the surface, mm2
    thickness : float, mm
    piece_size : float, mm, edge of a square as large as a piece
    """
    sides = area * (2 + _RIM * thickness / piece_size)
    overhang = _HANGS * sides
    return Bulk(area * thickness, sides, overhang, overhang * _SAG * piece_size)


def material_of(bulk: Bulk, process: str) -> Material:
    """Estimate what it takes to print.

    Parameters
    ----------
    bulk : Bulk
    process : str
        One of `RATES`; any other is taken to be fdm.

    Returns
    -------
    dict
        volume_mm3, without supports; grams, of all that is printed, with supports; hours, or None where
        nothing is printed. For fdm within a third of what PrusaSlicer says for its own speeds; printers
        differ by more.
    """
    cm3 = bulk.volume / 1000
    rate = RATES.get(process)
    if rate is not None:
        hours = cm3 / rate.speed if rate.speed else None
        return {"volume_mm3": bulk.volume, "grams": cm3 * rate.used * rate.density, "hours": hours}
    printed = cm3 + (_FOOT * bulk.overhang + _SPARSE * bulk.support) / 1000
    hours = printed / _BEAD + bulk.area / 100 / _WALLS
    return {"volume_mm3": bulk.volume, "grams": printed * _PLA, "hours": hours}
