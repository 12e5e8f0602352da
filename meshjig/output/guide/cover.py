"""The cover of the guide: what the puzzle will be, and how to read on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.types import Bools
from meshjig.output.guide.pages import LEFT, RIGHT, WIDTH, Sheets, text_width
from meshjig.output.piece import Piece

__all__ = ["cover_of_preview", "draw_cover", "title_of", "trimmed"]

_PICTURE = (160.0, 140.0)  # mm
_WHITE = 250
_TITLE = 30.0  # points; less where a name is long
_BOOK = (
    "In every picture the pieces placed so far are pale; the new ones are hatched, have dark borders and "
    "carry their numbers. The lightest shape behind is the finished model. A step that can't be shown from "
    "one side has more pictures."
)
_UNVERIFIED = (
    "The order goes from the bottom up, each piece beside one that is there already. Nobody has made sure "
    "that every piece can get to its place in it: where one does not go in, put it in before its neighbours."
)
_VERIFIED = "The order was checked: in it, every piece can get to its place."


def title_of(report: Mapping[str, Any]) -> str:
    """Give the name of the model's file, or Puzzle."""
    name = report.get("input", {}).get("file")
    return Path(str(name)).stem if name else "Puzzle"


def cover_of_preview(path: Path) -> NDArray[np.uint8]:
    """Cut the first of the four pictures out of preview.png: the puzzle put together."""
    from PIL import Image

    with Image.open(path) as sheet:
        return np.asarray(sheet.crop((0, 0, sheet.width // 2, sheet.height // 2)).convert("RGB"))


def trimmed(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Leave out the white border of a picture."""
    dark: Bools = np.any(picture < _WHITE, axis=2)
    rows, columns = np.flatnonzero(dark.any(axis=1)), np.flatnonzero(dark.any(axis=0))
    if not len(rows):
        return picture
    return picture[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def draw_cover(
    sheets: Sheets,
    pieces: Sequence[Piece],
    report: Mapping[str, Any],
    picture: NDArray[np.uint8],
    contents: Sequence[tuple[str, int]],
    *,
    n_plates: int,
    verified: bool,
) -> None:
    """Draw the first page.

    Parameters
    ----------
    sheets : Sheets
    pieces : sequence of Piece
    report : mapping
        Its ``input`` and ``options`` are told of, as far as they are there.
    picture : (h, w, 3) uint8
    contents : sequence of (str, int), chapters and their pages
    n_plates : int, 0 where pieces were not laid on plates
    verified : bool, somebody made sure that the order works
    """
    title = title_of(report)
    size = min(_TITLE, _TITLE * (RIGHT - LEFT) / text_width(title, _TITLE, strong=True))
    sheets.text(LEFT, 38, title, size, strong=True)
    sheets.text(
        LEFT, 47, f"A jigsaw puzzle of {_count(len(pieces), 'piece')}, in three dimensions", 13, grey=0.3
    )
    width, height = _PICTURE
    sheets.fitted((WIDTH - width) / 2, 56, width, height, picture)
    facts = _facts(pieces, report, n_plates)
    each = (RIGHT - LEFT) / len(facts)
    sheets.line(LEFT, 206, RIGHT, 206, grey=0.6)
    for k, (what, value) in enumerate(facts):
        sheets.text(LEFT + k * each, 213, what, 8, grey=0.35)
        sheets.text(LEFT + k * each, 219, value, 11, strong=True)
    sheets.line(LEFT, 224, RIGHT, 224, grey=0.6)
    y = 235.0
    sheets.text(LEFT, y, "How to read this guide", 11, strong=True)
    y = sheets.paragraph(LEFT, y + 6, 112, _BOOK)
    sheets.paragraph(LEFT, y + 2, 112, _VERIFIED if verified else _UNVERIFIED)
    y, left = 235.0, LEFT + 126
    sheets.text(left, y, "Contents", 11, strong=True)
    for chapter, page in contents:
        y += 6
        sheets.text(left, y, chapter, 9, grey=0.2)
        sheets.text(RIGHT, y, str(page), 9, align="right", grey=0.2)


def _facts(pieces: Sequence[Piece], report: Mapping[str, Any], n_plates: int) -> list[tuple[str, str]]:
    low = np.min([piece.V.min(axis=0) for piece in pieces], axis=0)
    high = np.max([piece.V.max(axis=0) for piece in pieces], axis=0)
    facts = [("Size", " × ".join(f"{side:.0f}" for side in high - low) + " mm")]
    options = report.get("options", {})
    facts += [
        (name.capitalize(), f"{options[name]:g} mm") for name in ("thickness", "clearance") if name in options
    ]
    if n_plates:
        facts.append(("Printed on", _count(n_plates, "plate")))
    return facts


def _count(n: int, what: str) -> str:
    return f"{n} {what}{'' if n == 1 else 's'}"
