"""Lists of scans, with options of their own, read row by row as they are used."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from meshjig.errors import InputError, OptionError, did_you_mean
from meshjig.fleet.inputs import Entry
from meshjig.fleet.places import is_url
from meshjig.options import Options

__all__ = ["count_rows", "read_list"]

_FILE = ("file", "mesh", "path", "url")  # what the column of the scans may be called


def read_list(path: Path) -> Iterator[Entry]:
    """Read a list of scans row by row.

    Parameters
    ----------
    path : Path
        .csv and .parquet have a column ``file``, and one for each option; any other file a scan a line.
        Relative paths are those of the current folder.

    Raises
    ------
    InputError, OptionError
        It can't be read; a column is no option.
    """
    if not path.is_file():
        raise InputError(f"--from: {path} is no file", hint="give a list of scans")
    kind = path.suffix.lower()
    rows = _csv_rows(path) if kind == ".csv" else _parquet_rows(path) if kind == ".parquet" else _lines(path)
    return _checked_rows(path, rows)


def _checked_rows(path: Path, rows: Iterator[tuple[str, Mapping[str, str]]]) -> Iterator[Entry]:
    try:
        for number, (source, given) in enumerate(rows, 1):
            if not source:
                continue
            where = f"row {number} of {path}"
            if is_url(source):
                yield Entry(source, source.partition("://")[2], given, where)
            else:
                yield Entry(os.path.abspath(source), source.replace(os.sep, "/"), given, where)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"--from: {path} can't be read ({error})", hint="save it as UTF-8") from None


def _lines(path: Path) -> Iterator[tuple[str, Mapping[str, str]]]:
    none: Mapping[str, str] = {}
    with path.open(encoding="utf-8-sig", errors="surrogateescape") as file:
        for line in file:
            yield line.strip("\r\n").strip(), none


def _csv_rows(path: Path) -> Iterator[tuple[str, Mapping[str, str]]]:
    with path.open(encoding="utf-8-sig", newline="") as file:
        rows = csv.DictReader(file)
        column, options = _columns(path, list(rows.fieldnames or ()))
        for row in rows:
            yield (row.get(column) or "").strip(), _cells(row, options)


def _parquet_rows(path: Path) -> Iterator[tuple[str, Mapping[str, str]]]:
    file = _parquet(path)
    column, options = _columns(path, list(file.schema_arrow.names))
    for batch in file.iter_batches(batch_size=4096):
        for row in batch.to_pylist():
            yield str(row.get(column) or "").strip(), _cells(row, options)


def _parquet(path: Path) -> Any:
    try:
        from pyarrow.parquet import ParquetFile
    except ImportError:
        raise InputError(
            f"--from: {path} needs pyarrow", hint="pip install pyarrow, or give a .csv"
        ) from None
    try:
        return ParquetFile(path)
    except (OSError, ValueError) as error:
        raise InputError(f"--from: {path} is no Parquet file, or damaged ({error})") from None


def _columns(path: Path, names: Sequence[str]) -> tuple[str, dict[str, str]]:
    """Give the column of the scans, and the options that the others are for."""
    column = next((name for name in names if name.strip().lower() in _FILE), None)
    if column is None:
        raise InputError(f"--from: {path} has no column named file", hint="write one above the scans")
    options = {}
    for name in names:
        option = name.strip().lstrip("-").replace("-", "_")
        if name == column:
            continue
        if option not in Options.model_fields:
            near = did_you_mean(option, Options.model_fields)
            raise OptionError(f"--from: {path} has a column {name!r}, which is no option", hint=near)
        options[name] = option
    return column, options


def _cells(row: Mapping[str, Any], options: Mapping[str, str]) -> dict[str, str]:
    cells = {option: row.get(name) for name, option in options.items()}
    return {option: str(cell).strip() for option, cell in cells.items() if cell not in (None, "")}


def count_rows(path: Path) -> int:
    """Give about how many scans a list has: its lines, without reading what is in them."""
    if path.suffix.lower() == ".parquet":
        return int(_parquet(path).metadata.num_rows)
    with path.open("rb") as file:
        lines = sum(block.count(b"\n") for block in iter(lambda: file.read(1 << 20), b""))
    return max(0, lines - (path.suffix.lower() == ".csv"))
