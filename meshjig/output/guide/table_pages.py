"""The table of the guide: for every piece its step, its plate and its neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

from meshjig.output.guide.pages import BOTTOM, LEFT, RIGHT, TOP, Document, Page, text_width, wrapped

__all__ = ["table_pages"]

_SIZE = 7.5  # points
_LINE = 3.9  # mm
_NUMBER = 7.5  # mm, the width of a column with a number
_LONGEST = 33.0  # mm, of a line of neighbours that makes columns wider
_GUTTER = 4.0
_FIRST = TOP + 2.2  # below the heads


class _Row(NamedTuple):
    numbers: list[str]
    lines: list[str]


def table_pages(
    neighbours: Sequence[Sequence[int]], steps: Sequence[Sequence[int]], plates: Sequence[int | None]
) -> list[Page]:
    """Lay out the table.

    Parameters
    ----------
    neighbours : sequence of sequence of int, pieces counted from 1
    steps : sequence of sequence of int, pieces counted from 1
    plates : sequence of int or None, no column where all are None

    Returns
    -------
    list of callables, each draws a page
    """
    step_of = {piece: str(number) for number, step in enumerate(steps, 1) for piece in step}
    with_plates = any(plate is not None for plate in plates)
    lists = [", ".join(map(str, near)) or "none" for near in neighbours]
    widest = min(max(text_width(words, _SIZE) for words in lists), _LONGEST) + 1
    heads = ["Piece", "Step", *(["Plate"] if with_plates else [])]
    numbers = _NUMBER * len(heads)
    side_by_side = max(int((RIGHT - LEFT + _GUTTER) // (numbers + widest + _GUTTER)), 1)
    width = (RIGHT - LEFT + _GUTTER) / side_by_side - _GUTTER
    rows = [
        _Row(
            [str(i), step_of.get(i, ""), *([str(plate or "")] if with_plates else [])],
            wrapped(words, _SIZE, width - numbers - 1),
        )
        for i, (words, plate) in enumerate(zip(lists, plates, strict=True), 1)
    ]
    n_lines = sum(len(row.lines) for row in rows)
    a_page = side_by_side * int((BOTTOM - _FIRST) / _LINE)
    n_columns = side_by_side * -(-n_lines // a_page)
    columns = _columns(rows, _FIRST + _LINE * (n_lines / n_columns + 1))
    pages = [columns[k : k + side_by_side] for k in range(0, len(columns), side_by_side)]
    return [partial(_draw, heads, page, width) for page in pages]


def _columns(rows: Sequence[_Row], bottom: float) -> list[list[_Row]]:
    """Fill one column after the other, down to a bottom, mm."""
    columns: list[list[_Row]] = [[]]
    y = _FIRST
    for row in rows:
        height = _LINE * len(row.lines)
        if y + height > min(bottom, BOTTOM) and columns[-1]:
            columns.append([])
            y = _FIRST
        columns[-1].append(row)
        y += height
    return columns


def _draw(heads: Sequence[str], columns: Sequence[Sequence[_Row]], width: float, document: Document) -> None:
    for k, column in enumerate(columns):
        left = LEFT + k * (width + _GUTTER)
        for j, head in enumerate([*heads, "Neighbours"]):
            document.text(left + 1 + j * _NUMBER, TOP, head, 7, grey=0.35)
        document.line(left, TOP + 1.6, left + width, TOP + 1.6, grey=0.4)
        y = _FIRST
        for i, row in enumerate(column):
            height = _LINE * len(row.lines)
            if i % 2:
                document.box(left, y, width, height, grey=0.94)
            for j, number in enumerate(row.numbers):
                document.text(left + 1 + j * _NUMBER, y + 2.9, number, _SIZE, strong=j == 0)
            for line, words in enumerate(row.lines):
                document.text(left + 1 + len(heads) * _NUMBER, y + 2.9 + line * _LINE, words, _SIZE)
            y += height
