"""The pages that say what there is: all pieces in outline, plate by plate."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from meshjig.output.guide.pages import BOTTOM, LEFT, RIGHT, TOP, Page, Sheets, text_width
from meshjig.output.guide.piece_outlines import Outline

__all__ = ["parts_pages"]

_A_PAGE = 130  # pieces, that should do with one page
_SCALES = (1.0, 0.75, 0.6, 0.5, 0.45, 0.4, 0.38, 0.36, 0.33, 0.3, 0.25, 0.2, 0.15, 0.1)
_GAP, _CAPTION, _HEADING = 2.6, 4.0, 7.5  # mm
_SMALL = 6.0  # points
_FIRST = TOP + 4.0  # below the words on how large things are drawn


class _Spot(NamedTuple):
    """A piece or a heading on a page."""

    page: int
    x: float
    y: float
    piece: int  # counted from 0; -1 for a heading
    words: str


def parts_pages(shapes: Sequence[Outline], plates: Sequence[int | None]) -> list[Page]:
    """Lay out the outlines of all pieces.

    Parameters
    ----------
    shapes : sequence of Outline
    plates : sequence of int or None
        The plate that holds each piece; None where that is not known.

    Returns
    -------
    list of callables, each draws a page
    """
    wanted = -(-len(shapes) // _A_PAGE)
    spots: list[_Spot] = []
    scale = 1.0
    for scale in _SCALES:
        spots = _flow(shapes, plates, scale)
        if spots[-1].page < wanted:
            break
    n = spots[-1].page + 1
    return [partial(_draw, shapes, scale, [spot for spot in spots if spot.page == page]) for page in range(n)]


def _flow(shapes: Sequence[Outline], plates: Sequence[int | None], scale: float) -> list[_Spot]:
    """Put pieces into columns of one width, row by row, under a heading for each plate."""
    sizes = np.array([shape.size for shape in shapes]) * scale
    least = text_width(f"{len(shapes)}", 8, strong=True) + text_width("100 × 100", _SMALL) + 1.5
    a_row = max(int((RIGHT - LEFT + _GAP) // (max(sizes[:, 0].max(), least) + _GAP)), 1)
    width = (RIGHT - LEFT + _GAP) / a_row
    spots: list[_Spot] = []
    page, y = 0, _FIRST
    for plate in sorted(set(plates), key=lambda plate: (plate is None, plate)):
        mine = [i for i, other in enumerate(plates) if other == plate]
        for k in range(0, len(mine), a_row):
            row = mine[k : k + a_row]
            heading = _HEADING if k == 0 else 0.0
            height = float(sizes[row, 1].max()) + _CAPTION
            if y + heading + height > BOTTOM and y > _FIRST:
                page, y = page + 1, _FIRST
            if k == 0:
                spots.append(_Spot(page, LEFT, y + 5, -1, _heading(plate, mine)))
            y += heading + height
            spots += [_Spot(page, LEFT + j * width, y, i, "") for j, i in enumerate(row)]
            y += _GAP
    return spots


def _heading(plate: int | None, mine: list[int]) -> str:
    count = f"{len(mine)} piece{'' if len(mine) == 1 else 's'}"
    return count if plate is None else f"Plate {plate}: {count}"


def _draw(shapes: Sequence[Outline], scale: float, spots: Sequence[_Spot], sheets: Sheets) -> None:
    sheets.text(
        LEFT,
        TOP,
        f"Seen from outside, {_said(scale)}; below each, its number, and its length and width in mm.",
        8,
        grey=0.35,
    )
    for spot in spots:
        if spot.piece < 0:
            sheets.text(spot.x, spot.y, spot.words, 10, strong=True)
            continue
        shape = shapes[spot.piece]
        floor = spot.y - _CAPTION
        sheets.shape(shape.ring * (scale, -scale) + (spot.x, floor))
        number = str(spot.piece + 1)
        sheets.text(spot.x, spot.y - 1.2, number, 8, strong=True)
        size = " × ".join(f"{side:.0f}" for side in shape.size)
        sheets.text(spot.x + text_width(number, 8, strong=True) + 1.5, spot.y - 1.2, size, _SMALL, grey=0.35)


def _said(scale: float) -> str:
    return "in true size" if scale == 1 else f"at {100 * scale:.0f} % of true size"
