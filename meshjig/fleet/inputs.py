"""The scans of a batch: files, folders, patterns and URLs; and lists of them, read as they are used."""

from __future__ import annotations

import csv
import glob
import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from meshjig.errors import InputError, OptionError, did_you_mean
from meshjig.fleet.names import Names
from meshjig.fleet.places import is_url, reach
from meshjig.options import Options

__all__ = ["Entry", "count_rows", "entries", "expand", "read_list"]

_MESHES = {".stl", ".obj", ".ply", ".off", ".glb", ".gltf", ".3mf"}
_FILE = ("file", "mesh", "path", "url")  # what the column of the scans may be called
_MAGIC = set("*?[")


class Entry(NamedTuple):
    """A scan, before it has a name."""

    source: str  # path, absolute, or URL
    relative: str  # its path below what was given
    given: Mapping[str, str] = {}  # options of its own
    where: str = ""  # in a list, for sentences


def expand(inputs: Sequence[str], out: str) -> list[Entry]:
    """Find the scans that words of a command line stand for, sorted within each.

    Parameters
    ----------
    inputs : paths of files and folders, patterns, URLs of files, of folders (they end with a slash), and of
        patterns
    out : str, the folder of the batch; what lies in it is no scan

    Raises
    ------
    InputError
        One stands for nothing.
    """
    found = []
    for given in inputs:
        some = list(_of_url(given) if is_url(given) else _of_path(given, os.path.abspath(out)))
        if not some:
            raise InputError(f"{given} holds no scan", hint=f"known are {', '.join(sorted(_MESHES))}")
        found += some
    return found


def entries(inputs: Sequence[Entry], rows: Iterable[Entry]) -> Iterator[tuple[str, Entry]]:
    """Give every scan its name, in their order.

    Where several of the inputs have a name, all keep their relative paths. Of a list, which is read as it is
    used, the first has the name.
    """
    names = Names()
    for stem, n in Counter(Path(entry.relative).stem.casefold() for entry in inputs).items():
        if n > 1:
            names.share(stem)
    for entry in inputs:
        yield names.give(entry.relative), entry
    for entry in rows:
        yield names.give(entry.relative), entry


def _of_path(given: str, out: str) -> Iterator[Entry]:
    if os.path.isdir(given):
        for above, folders, files in os.walk(given, followlinks=True):
            folders[:] = sorted(
                name
                for name in folders
                if not name.startswith(".") and os.path.abspath(os.path.join(above, name)) != out
            )
            for name in sorted(files):
                if _is_mesh(name) and not name.startswith("."):
                    path = os.path.join(above, name)
                    yield Entry(os.path.abspath(path), os.path.relpath(path, given).replace(os.sep, "/"))
    elif _MAGIC & set(given) and not os.path.lexists(given):
        root = _fixed(given)
        for path in sorted(glob.glob(given, recursive=True)):
            if os.path.isfile(path):
                yield Entry(os.path.abspath(path), os.path.relpath(path, root).replace(os.sep, "/"))
    else:
        yield Entry(os.path.abspath(given), given.replace(os.sep, "/"))


def _of_url(given: str) -> Iterator[Entry]:
    listed = given.endswith("/") or bool(_MAGIC & set(given.partition("://")[2]))
    if not listed or given.startswith(("http://", "https://")):
        yield Entry(given, given.partition("://")[2])
        return
    system, path = reach(given)
    scheme = given.partition("://")[0]
    root = _fixed(path) if _MAGIC & set(path) else path.rstrip("/")
    try:
        found = system.glob(path) if _MAGIC & set(path) else system.find(path)
    except (OSError, ValueError) as error:
        raise InputError(f"{given} can't be listed ({error})", hint="check the URL") from None
    for one in sorted(map(str, found)):
        if _is_mesh(one):
            yield Entry(f"{scheme}://{one}", one.removeprefix(root).lstrip("/"))


def _fixed(pattern: str) -> str:
    """Give the folder above the first part of a pattern that can vary."""
    parts = pattern.split("/")
    fixed = next(i for i, part in enumerate(parts) if _MAGIC & set(part))
    return "/".join(parts[:fixed]) or ("/" if pattern.startswith("/") else ".")


def _is_mesh(name: str) -> bool:
    return os.path.splitext(name)[1].lower() in _MESHES


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
