"""The guide: a PDF that shows what there is and how to put it together."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import OutputError
from meshjig.output.guide.cover import draw_cover, title_of, trimmed
from meshjig.output.guide.light_model import joint_of
from meshjig.output.guide.pages import Page, Sheets
from meshjig.output.guide.parts_pages import parts_pages
from meshjig.output.guide.piece_outlines import outlines
from meshjig.output.guide.steps_pages import steps_pages
from meshjig.output.guide.table_pages import table_pages
from meshjig.output.order import assembly_of
from meshjig.output.pictures.whole import draw_whole
from meshjig.output.piece import Piece

__all__ = ["FILE", "write_guide"]

FILE = "guide.pdf"


def write_guide(
    path: Path,
    pieces: Sequence[Piece],
    report: Mapping[str, Any],
    *,
    plates: Mapping[str, int] | None = None,
    cover: Callable[[], NDArray[np.uint8] | None] | None = None,
) -> None:
    """Write a guide on A4, good in black and white too. Equal input gives equal bytes.

    Parameters
    ----------
    path : Path
    pieces : sequence of Piece, at least one
    report : mapping
        ``input`` gives the title, ``pieces`` the neighbours, ``assembly`` the order; what is missing is
        left out, or made.
    plates : mapping, optional
        The plate that holds each piece, by the piece's name.
    cover : callable, optional
        Gives a picture of the puzzle, (k, k, 3) uint8, and is asked as late as can be; without one, or where
        it gives None, it is drawn.

    Raises
    ------
    OutputError
        There are no pieces.
    """
    if not pieces:
        raise OutputError("a puzzle without pieces can't be shown", hint="make one first")
    assembly = assembly_of(pieces, report)
    on_plate = [(plates or {}).get(piece.name) for piece in pieces]
    listed = report.get("pieces", ())

    @functools.cache
    def picture() -> NDArray[np.uint8]:
        given = None if cover is None else cover()
        return trimmed(draw_whole(pieces) if given is None else given)

    joint = joint_of(pieces)
    chapters = [
        ("What you have", parts_pages(outlines(joint), on_plate)),
        ("Putting it together", steps_pages(joint, assembly.steps, picture)),
    ]
    if len(listed) == len(pieces):
        neighbours = [entry["neighbours"] for entry in listed]
        chapters.append(("Who borders on whom", table_pages(neighbours, assembly.steps, on_plate)))
    starts = np.cumsum([2, *(len(pages) for _, pages in chapters)]).tolist()
    contents = [(name, start) for (name, _), start in zip(chapters, starts, strict=False)]
    n_plates = len({plate for plate in on_plate if plate is not None})
    with Sheets(path, title_of(report), n_pages=starts[-1] - 1) as sheets:
        draw_cover(sheets, pieces, report, picture(), contents, n_plates=n_plates, verified=assembly.verified)
        sheets.end_page("")
        for name, pages in chapters:
            _write(sheets, name, pages)


def _write(sheets: Sheets, name: str, pages: Sequence[Page]) -> None:
    for number, draw in enumerate(pages):
        if number == 0:
            sheets.bookmark(name)
        draw(sheets)
        sheets.end_page(name)
