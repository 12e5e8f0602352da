"""All that the files of a puzzle hold, read by a process that may be ended."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from meshjig.errors import InputError
from meshjig.output.files.read_pieces import NamedPiece, read_core, read_pieces
from meshjig.output.files.report_file import read_report
from meshjig.runtime.bounded import Bounded, OutOfBounds

__all__ = ["PuzzleFiles", "read_puzzle_files"]


class PuzzleFiles(NamedTuple):
    """What a folder, or files, of pieces hold."""

    pieces: list[NamedPiece]
    core: list[NamedPiece]
    report: dict[str, Any] | None  # None where there is none


def read_puzzle_files(paths: Sequence[str | os.PathLike[str]]) -> PuzzleFiles:
    """Read pieces, core and report in a process of its own, within limits of memory and time.

    Parameters
    ----------
    paths : see `read_pieces`. Only a single folder has a core, and a report.

    Raises
    ------
    InputError
        Nothing found, or a file that can't be read.
    """
    given = [os.fspath(path) for path in paths]
    try:
        return Bounded(__name__, "_read", given).result()
    except OutOfBounds as error:
        name = given[0] if len(given) == 1 else f"one of {len(given)} files"
        raise InputError(f"{name} {error}", hint="export it again, or give its files one by one") from None


def _read(paths: list[str]) -> PuzzleFiles:
    report = Path(paths[0]) / "report.json" if len(paths) == 1 else None
    there = report is not None and os.path.lexists(report)
    return PuzzleFiles(
        read_pieces(paths), read_core(paths), read_report(report) if report and there else None
    )
