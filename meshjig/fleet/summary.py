"""The table of a batch: a row a scan, as CSV and, where pyarrow is there, as Parquet."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

from meshjig.errors import printable
from meshjig.fleet.record import Record

__all__ = ["write_csv", "write_parquet"]

_ROWS = 10_000  # that are held at a time


def _row(record: Record) -> dict[str, object]:
    size = [*record.size_mm, None, None, None]
    return {
        "name": record.name,
        "source": record.source,
        "outcome": record.outcome,
        "kind": record.kind,
        "sentence": printable(record.sentence),
        "stage": record.stage,
        "exit": record.exit,
        "signal": record.signal,
        "seconds": float(record.seconds),
        "peak_mb": float(record.peak_mb),
        "pieces": record.pieces,
        "x_mm": size[0],
        "y_mm": size[1],
        "z_mm": size[2],
        "faces": record.faces,
        "broken": " ".join(record.broken),
        "attempts": record.attempts,
        "host": record.host,
        "input_sha256": record.marks.input,
        "options_sha256": record.marks.options,
        "version": record.marks.version,
    }


def write_csv(path: Path, records: Iterable[Record]) -> None:
    """Write a row a record."""
    with path.open("w", encoding="utf-8", errors="backslashreplace", newline="") as file:
        writer = csv.DictWriter(file, list(_row(Record("", "", ""))))
        writer.writeheader()
        writer.writerows(map(_row, records))


def write_parquet(path: Path, records: Iterable[Record]) -> bool:
    """Write a row a record; tell whether pyarrow is there to do so."""
    try:
        import pyarrow as pa
        from pyarrow.parquet import ParquetWriter
    except ImportError:
        return False
    numbers = {"seconds", "peak_mb", "x_mm", "y_mm", "z_mm"}
    whole = {"exit", "signal", "pieces", "faces", "attempts"}
    kinds = {
        name: pa.float64() if name in numbers else pa.int64() if name in whole else pa.string()
        for name in _row(Record("", "", ""))
    }
    schema = pa.schema(list(kinds.items()))
    with ParquetWriter(path, schema) as writer:
        for rows in _tables(records):
            writer.write_table(pa.Table.from_pylist(rows, schema=schema))
    return True


def _tables(records: Iterable[Record]) -> Iterator[list[dict[str, object]]]:
    rows = map(_row, records)
    while some := list(islice(rows, _ROWS)):
        yield [{k: _text(v) if isinstance(v, str) else v for k, v in row.items()} for row in some]


def _text(value: str) -> str:
    return value.encode("utf-8", "backslashreplace").decode()
