"""The guide: a PDF that shows what there is and how to put it together."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import OutputError
from meshjig.mesh.arrays import Bools
from meshjig.mesh.mesh import concatenate
from meshjig.output.guide.arrows import arrows_of
from meshjig.output.guide.pages import LEFT, RIGHT, WIDTH, Document, Page, text_width
from meshjig.output.guide.parts_pages import outlines, parts_pages
from meshjig.output.guide.proxy import join_pieces
from meshjig.output.guide.steps_pages import steps_pages
from meshjig.output.guide.table_pages import table_pages
from meshjig.output.order import assembly_of, ways_out
from meshjig.output.pictures.preview import draw_whole
from meshjig.output.pictures.view import up_of
from meshjig.output.piece import Piece
from meshjig.output.report import title_of

__all__ = ["FILE", "cover_of_preview", "trimmed", "write_guide"]


FILE = "guide.pdf"

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
_ARROWS = (
    "An arrow shows how a new piece goes in; a grey one comes from behind. Put in the pieces of a step in "
    "the order in which they are named."
)
_TRIED = "Every piece was tried on the finished shapes, in this order: it goes straight in along its arrow."
_NOT_ALL = (
    "The order and the arrows are a plan that was tried on the finished shapes, where {} go straight in. "
    "Where one of the others does not go in, put it in before its neighbours."
)


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
        ``input`` gives the title, ``pieces`` the neighbours, ``assembly`` the order, ``up`` which way
        pictures show it; what is missing is left out, or made.
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
    V, F, _, _ = concatenate(pieces)
    up = up_of(report, V, F)
    assembly = assembly_of(pieces, report)
    on_plate = [(plates or {}).get(piece.name) for piece in pieces]
    listed = report.get("pieces", ())

    @functools.cache
    def picture() -> NDArray[np.uint8]:
        given = None if cover is None else cover()
        return trimmed(draw_whole(pieces, up=up) if given is None else given)

    joined = join_pieces(pieces, up)
    ways = ways_out(report, len(pieces))
    arrows = None if ways is None else arrows_of(joined, ways)
    chapters = [
        ("What you have", parts_pages(outlines(joined), on_plate)),
        ("Putting it together", steps_pages(joined, assembly.steps, picture, arrows)),
    ]
    if len(listed) == len(pieces):
        neighbours = [entry["neighbours"] for entry in listed]
        chapters.append(("Who borders on whom", table_pages(neighbours, assembly.steps, on_plate)))
    starts = np.cumsum([2, *(len(pages) for _, pages in chapters)]).tolist()
    contents = [(name, start) for (name, _), start in zip(chapters, starts, strict=False)]
    n_plates = len({plate for plate in on_plate if plate is not None})
    facts = _facts(pieces, report, n_plates)
    first = _Cover(
        title_of(report), len(pieces), facts, contents, _words(report, ways is not None, assembly.verified)
    )
    with Document(path, first.title, n_pages=starts[-1] - 1) as document:
        _draw_cover(document, first, picture())
        document.end_page("")
        for name, pages in chapters:
            _write(document, name, pages)


def _write(document: Document, name: str, pages: Sequence[Page]) -> None:
    for number, draw in enumerate(pages):
        if number == 0:
            document.bookmark(name)
        draw(document)
        document.end_page(name)


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


class _Cover(NamedTuple):
    """What the first page says."""

    title: str
    n_pieces: int
    facts: list[tuple[str, str]]
    contents: list[tuple[str, int]]  # chapters and their pages
    words: list[str]  # how to read the steps, and whether somebody made sure that their order works


def _draw_cover(document: Document, cover: _Cover, picture: NDArray[np.uint8]) -> None:
    size = min(_TITLE, _TITLE * (RIGHT - LEFT) / text_width(cover.title, _TITLE, strong=True))
    document.text(LEFT, 38, cover.title, size, strong=True)
    document.text(
        LEFT, 47, f"A jigsaw puzzle of {_count(cover.n_pieces, 'piece')}, in three dimensions", 13, grey=0.3
    )
    width, height = _PICTURE
    document.fitted((WIDTH - width) / 2, 56, width, height, picture)
    each = (RIGHT - LEFT) / len(cover.facts)
    document.line(LEFT, 206, RIGHT, 206, grey=0.6)
    for k, (what, value) in enumerate(cover.facts):
        document.text(LEFT + k * each, 213, what, 8, grey=0.35)
        document.text(LEFT + k * each, 219, value, 11, strong=True)
    document.line(LEFT, 224, RIGHT, 224, grey=0.6)
    y = 235.0
    document.text(LEFT, y, "How to read this guide", 11, strong=True)
    y += 6
    for words in cover.words:
        y = document.paragraph(LEFT, y, 112, words) + 2
    y, left = 235.0, LEFT + 126
    document.text(left, y, "Contents", 11, strong=True)
    for chapter, page in cover.contents:
        y += 6
        document.text(left, y, chapter, 9, grey=0.2)
        document.text(RIGHT, y, str(page), 9, align="right", grey=0.2)


def _words(report: Mapping[str, Any], with_arrows: bool, verified: bool) -> list[str]:
    """Say how to read the steps, and how far the order is to be trusted."""
    if not with_arrows:
        return [_BOOK, _VERIFIED if verified else _UNVERIFIED]
    if verified:
        return [f"{_BOOK} {_ARROWS}", _TRIED]
    plan = report["assembly"]
    n, proved = len(plan["motions"]), plan.get("proved", 0)
    return [f"{_BOOK} {_ARROWS}", _NOT_ALL.format(f"{proved} of {n} pieces")]


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
