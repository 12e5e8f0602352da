"""The tables of a PLY file, text or binary, as columns."""

from __future__ import annotations

import struct
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Ints, ranks, starts
from meshjig.scan.files.formats import half_a_face
from meshjig.scan.files.ply_head import Element, Head
from meshjig.scan.files.words import NONE, Lines, plain

__all__ = ["Broken", "Columns", "Lists", "read_tables"]

_CODES = {
    "i1": "b",
    "u1": "B",
    "i2": "h",
    "u2": "H",
    "i4": "i",
    "u4": "I",
    "i8": "q",
    "u8": "Q",
    "f4": "f",
    "f8": "d",
}


class Lists(NamedTuple):
    """Lists of different lengths."""

    values: NDArray
    sizes: Ints  # (r,)


class Columns(NamedTuple):
    """A table."""

    scalars: dict[str, NDArray]  # (r,) each
    lists: dict[str, Lists]
    kinds: dict[str, str]  # the types that the head gives them


class Broken(Exception):
    """The tables are not as the head says; the text says how, to follow the file's name."""


def read_tables(head: Head, data: bytes) -> dict[str, Columns]:
    """Read all elements.

    Parameters
    ----------
    head : Head
    data : bytes, the whole file

    Returns
    -------
    dict of str to Columns
        A row of text that has too few words has NaN, or ``NONE``, for what is missing, and empty lists.

    Raises
    ------
    Broken
    """
    tables = {}
    if not head.order:
        lines = Lines(plain(data[head.size :]))
        filled = np.flatnonzero(lines.sizes)
        wanted = sum(element.count for element in head.elements)
        if len(filled) < wanted:
            raise Broken(f"is cut off: it announces {wanted} vertices and faces and holds {len(filled)}")
        done = 0
        for element in head.elements:
            tables[element.name] = _of_lines(element, lines.only(filled[done : done + element.count]))
            done += element.count
        begins = head.elements[-1].properties[:1] if 0 < wanted == len(filled) else []
        missing = half_a_face(lines.line(int(filled[wanted - 1]))) if begins and begins[0].count_kind else ""
        if missing:
            raise Broken(f"is cut off: {missing}")
        return tables
    cells, at = _Bytes(np.frombuffer(data, np.uint8), head.order), head.size
    for element in head.elements:
        tables[element.name], at = _of_bytes(element, cells, at)
    return tables


class _Words:
    """Where values are words, each of width 1."""

    def __init__(self, values: NDArray) -> None:
        self.values = values
        self.missing = NONE if values.dtype == np.int64 else np.nan

    def width(self, kind: str) -> int:
        return 1

    def take(self, at: Ints, kind: str) -> NDArray:
        return self.values[at]


class _Bytes:
    """Where values are bytes."""

    missing = 0

    def __init__(self, values: NDArray, order: str) -> None:
        self.values, self.order = values, order

    def width(self, kind: str) -> int:
        return int(kind[1])

    def take(self, at: Ints, kind: str) -> NDArray:
        out = np.empty((len(at), self.width(kind)), np.uint8)
        for k in range(out.shape[1]):
            out[:, k] = self.values[at + k]
        return out.view(self.order + kind).reshape(-1)


def _of_lines(element: Element, rows: Lines) -> Columns:
    """A table of text, a row a line; a row that has too few words ends where its line ends."""
    whole = any(p.count_kind for p in element.properties) and all(
        p.kind[0] in "iu" for p in element.properties
    )
    end = np.cumsum(rows.sizes)
    cells = _Words(rows.integers() if whole else rows.floats())
    return _columns(element, cells, starts(rows.sizes), end)


def _of_bytes(element: Element, cells: _Bytes, at: int) -> tuple[Columns, int]:
    """A table of bytes that begins somewhere, and where the next one does."""
    room = len(cells.values) - at
    if not element.properties:
        return Columns({}, {}, {}), at
    if not any(p.count_kind for p in element.properties):
        fields = [(str(k), cells.order + p.kind) for k, p in enumerate(element.properties)]
        row = np.dtype(fields)
        if row.itemsize * element.count > room:
            raise Broken(
                f"is cut off: it announces {element.count} elements '{element.name}'"
                f" and holds {room // row.itemsize}"
            )
        part = cells.values[at : at + row.itemsize * element.count]
        rows = part.view(row)
        scalars = {p.name: rows[str(k)] for k, p in enumerate(element.properties)}
        return Columns(scalars, {}, _kinds(element)), at + len(part)
    first = _equal_rows(element, cells, at)
    if first is None:
        first = _walk(element, cells, at)
    table = _columns(element, cells, first[:-1], np.repeat(first[-1], element.count))
    return table, int(first[-1])


def _equal_rows(element: Element, cells: _Bytes, at: int) -> Ints | None:
    """Where rows begin, and where the last ends, if they are all as long as the first."""
    if not element.count:
        return np.array([at])
    offsets, step = [], 0
    for p in element.properties:
        if p.count_kind:
            place = np.array([at + step])
            if at + step + cells.width(p.count_kind) > len(cells.values):
                return None
            size = int(cells.take(place, p.count_kind)[0])
            offsets.append((step, p.count_kind, size))
            step += cells.width(p.count_kind) + max(size, 0) * cells.width(p.kind)
        else:
            step += cells.width(p.kind)
    first = at + step * np.arange(element.count + 1)
    if first[-1] > len(cells.values):
        return None
    equal = all((cells.take(first[:-1] + k, kind) == size).all() for k, kind, size in offsets)
    return first if equal else None


def _walk(element: Element, cells: _Bytes, at: int) -> Ints:
    """Where rows begin, and where the last ends: each follows from the one before."""
    data, first = cells.values.tobytes(), np.empty(element.count + 1, np.int64)
    steps, fixed = [], 0
    for p in element.properties:
        if p.count_kind:
            read = struct.Struct(cells.order + _CODES[p.count_kind]).unpack_from
            steps.append((fixed, read, cells.width(p.count_kind), cells.width(p.kind)))
            fixed = 0
        else:
            fixed += cells.width(p.kind)
    row = 0
    try:
        for row in range(element.count):
            first[row] = at
            for before, read, count_width, width in steps:
                at += before
                at += count_width + width * int(read(data, at)[0])
            at += fixed
            if not first[row] < at <= len(data):
                break
        else:
            first[-1] = at
            return first
    except (struct.error, ValueError, OverflowError):
        pass
    raise Broken(
        f"is damaged or cut off: row {row} of its {element.count} elements '{element.name}'"
        " reaches beyond the end"
    )


def _columns(element: Element, cells: _Words | _Bytes, at: Ints, end: Ints) -> Columns:
    """Take rows apart that begin and end somewhere."""
    table = Columns({}, {}, _kinds(element))
    for p in element.properties:
        width = cells.width(p.count_kind or p.kind)
        there = at + width <= end
        values = cells.take(at[there], p.count_kind or p.kind)
        if not there.all():
            some, values = values, np.full(len(at), cells.missing, values.dtype)
            values[there] = some
        at = at + width
        if not p.count_kind:
            table.scalars[p.name] = values
            continue
        width = cells.width(p.kind)
        good = there & (values >= 0) & (values <= (end - at) // width)
        sizes = np.where(good, values, 0).astype(np.int64)
        at = np.where(good, at, end)
        table.lists[p.name] = Lists(cells.take(_places(at, sizes, width), p.kind), sizes)
        at = at + sizes * width
    return table


def _places(at: Ints, sizes: Ints, width: int) -> Ints:
    """Where the entries of lists are that begin somewhere."""
    return np.repeat(at, sizes) + width * ranks(sizes)


def _kinds(element: Element) -> dict[str, str]:
    return {p.name: p.kind for p in element.properties}
