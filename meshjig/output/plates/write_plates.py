"""Pieces laid out for printing: a 3MF a plate, and a sheet that says what is where."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.output.files.threemf import write_3mf
from meshjig.output.piece import Piece
from meshjig.output.plates.lay_out import GAP, LeftOut, PlacedPiece, lay_out
from meshjig.output.plates.printers import Nesting, Plate

__all__ = ["OnPlate", "draw_plates", "number_of", "write_plates"]


_MARGIN = 8.0  # mm around each sheet
_TITLE = 9.0  # mm above each sheet
_PIXELS = 4.0  # a mm
_LARGEST = 6000  # pixels along a side of the PNG
_PAPER, _PLATE, _PIECE, _INK = "#ffffff", "#ffffff", "#dcdcdc", "#000000"


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


def number_of(name: str) -> str:
    """Give what to write on a piece: the number that its name ends with, or the name.

    A part of a core says so.
    """
    found = re.search(r"(\d+)$", name)
    number = str(int(found[1])) if found else name
    return f"core {number}" if name.startswith("core_") else number


def draw_plates(folder: Path, placed: Sequence[PlacedPiece], plate: Plate) -> None:
    """Write plates.svg and plates.png: every plate from above, with its pieces and their numbers.

    Parameters
    ----------
    folder : Path, which exists
    placed : sequence of PlacedPiece
    plate : Plate
    """
    n = max((item.plate for item in placed), default=0)
    columns = int(np.ceil(np.sqrt(n * plate.depth / plate.width))) or 1
    cell = np.array([plate.width + 2 * _MARGIN, plate.depth + 2 * _MARGIN + _TITLE])
    size = cell * np.array([columns, -(-n // columns)])
    corners = [cell * np.array([k % columns, k // columns]) + (_MARGIN, _MARGIN + _TITLE) for k in range(n)]
    titles = [
        f"plate {k + 1} of {n}: {sum(item.plate == k + 1 for item in placed)} pieces, {plate}"
        for k in range(n)
    ]
    drawn = [_shown(item, corners[item.plate - 1], plate) for item in placed]
    _write_svg(folder / "plates.svg", size, corners, titles, drawn, plate)
    _write_png(folder / "plates.png", size, corners, titles, drawn, plate)


class _Shown:
    """One piece as it is drawn: rings and the place of its number, in mm, y downward."""

    def __init__(self, rings: list[Floats], at: Floats, height: float, text: str) -> None:
        self.rings, self.at, self.height, self.text = rings, at, height, text


def _shown(item: PlacedPiece, corner: Floats, plate: Plate) -> _Shown:
    """Place a piece on its sheet, its number where the outline leaves most room."""
    import shapely

    outline = item.outline
    rings = [
        _down(np.array(ring.coords)[:-1], corner, plate) for ring in (outline.exterior, *outline.interiors)
    ]
    circle = shapely.maximum_inscribed_circle(outline, tolerance=0.2)
    middle, edge = np.array(circle.coords)
    radius = float(np.hypot(*(middle - edge)))
    text = number_of(item.piece.name)
    height = min(7.0, 2 * radius / np.hypot(1, 0.6 * len(text)))
    return _Shown(rings, _down(middle, corner, plate), height, text)


def _down(points: Floats, corner: Floats, plate: Plate) -> Floats:
    """Take points on a plate to the picture, whose y runs downward."""
    return corner + points * (1, -1) + (0, plate.depth)


def _write_svg(
    path: Path, size: Floats, corners: list[Floats], titles: list[str], drawn: list[_Shown], plate: Plate
) -> None:
    parts = []
    for (x, y), title in zip(corners, titles, strict=True):
        parts.append(
            f'<rect x="{x:.2f}" y="{y:.2f}" width="{plate.width:g}" height="{plate.depth:g}" '
            f'fill="{_PLATE}" stroke="{_INK}" stroke-width="0.6"/>'
            f'<text x="{x:.2f}" y="{y - 3:.2f}" font-size="6">{title}</text>'
        )
    for piece in drawn:
        data = "".join(
            "M" + "L".join(f"{x:.2f} {y:.2f}" for x, y in ring.tolist()) + "Z" for ring in piece.rings
        )
        x, y = piece.at
        parts.append(
            f'<path d="{data}" fill="{_PIECE}" fill-rule="evenodd" stroke="{_INK}" stroke-width="0.3"/>'
            f'<text x="{x:.2f}" y="{y + 0.36 * piece.height:.2f}" font-size="{piece.height:.2f}" '
            f'text-anchor="middle">{escape(piece.text)}</text>'
        )
    width, height = size.tolist()
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}mm" height="{height:g}mm" '
        f'viewBox="0 0 {width:g} {height:g}" font-family="sans-serif">\n'
        f"<title>what lies where on which plate</title>\n{chr(10).join(parts)}\n</svg>\n",
        encoding="utf-8",
    )


def _write_png(
    path: Path, size: Floats, corners: list[Floats], titles: list[str], drawn: list[_Shown], plate: Plate
) -> None:
    """Draw twice as large, and shrink: Pillow's lines have hard edges."""
    from PIL import Image, ImageDraw, ImageFont

    scale = 2 * min(_PIXELS, _LARGEST / float(size.max()))
    image = Image.new("L", tuple(np.ceil(scale * size).astype(int).tolist()), _PAPER)
    pen = ImageDraw.Draw(image)

    def write(at: Floats, text: str, height: float, anchor: str) -> None:
        font: Any = ImageFont.load_default(max(scale * height, 1.0))
        pen.text(tuple(scale * at), text, fill=_INK, font=font, anchor=anchor)

    for corner, title in zip(corners, titles, strict=True):
        box = np.stack([corner, corner + plate[:2]]) * scale
        pen.rectangle([tuple(xy) for xy in box.tolist()], fill=_PLATE, outline=_INK, width=round(0.6 * scale))
        write(corner - (0, 3), title, 6, "ls")
    for piece in drawn:
        for ring, fill in zip(piece.rings, [_PIECE] + [_PLATE] * len(piece.rings), strict=False):
            points = [tuple(xy) for xy in (scale * ring).tolist()]
            pen.polygon(points, fill=fill)
            pen.line([*points, points[0], points[1]], fill=_INK, width=round(0.3 * scale), joint="curve")
        write(piece.at, piece.text, piece.height, "mm")
    image.resize((image.width // 2, image.height // 2), Image.Resampling.BOX).save(path)
