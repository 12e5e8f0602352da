"""Pieces laid out for printing: a 3MF a plate, and a sheet that says what is where."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from meshjig.output.files.threemf import write_3mf
from meshjig.output.piece import Piece
from meshjig.output.plates.lay_out import GAP, LeftOut, PlacedPiece, lay_out
from meshjig.output.plates.plate_sheet import draw_plates
from meshjig.output.plates.printers import Nesting, Plate

__all__ = ["OnPlate", "write_plates"]


@dataclass(frozen=True)
class OnPlate:
    """A piece on its plate, as the report's ``plates`` have it."""

    name: str
    plate: int  # counted from 1
    x_mm: float  # the middle of the piece on it
    y_mm: float
    height_mm: float
    overhang_share: float  # of its surface
    outer_up: bool | None  # None where the outer side was not known


def write_plates(
    folder: Path, pieces: Sequence[Piece], plate: Plate, *, gap: float = GAP, nest: Nesting = "fast"
) -> list[OnPlate | LeftOut]:
    """Write plates/plate_01.3mf and so on, plates.svg and plates.png.

    Parameters
    ----------
    folder : Path, which exists
    pieces, plate, gap, nest : see `lay_out`

    Returns
    -------
    list of OnPlate, one a piece, in order; at the end, as LeftOut, those that fit no plate

    Raises
    ------
    OptionError
        See `lay_out`.
    """
    placed, left_out = lay_out(pieces, plate, gap=gap, nest=nest)
    (folder / "plates").mkdir()
    n_plates = max((item.plate for item in placed), default=0)
    for number in range(1, n_plates + 1):
        path = folder / "plates" / f"plate_{number:02d}.3mf"
        title = f"meshjig plate {number} of {n_plates}"
        write_3mf(path, (item.piece for item in placed if item.plate == number), title)
    draw_plates(folder, placed, plate)
    return [*map(_fact, placed), *left_out]


def _fact(item: PlacedPiece) -> OnPlate:
    x, y = (item.piece.V.min(axis=0) + item.piece.V.max(axis=0))[:2] / 2
    pose = item.pose
    return OnPlate(item.piece.name, item.plate, float(x), float(y), pose.height, pose.overhang, pose.outer_up)
