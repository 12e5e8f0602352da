"""Whether a puzzle that is there is the one that would be made: by its report, and hashes of its files."""

from __future__ import annotations

from pathlib import Path

from meshjig.errors import InputError
from meshjig.fleet.record import BROKEN, MADE, Record
from meshjig.output.folder.manifest import REPORT, read_manifest, stranger
from meshjig.output.report import Report, read_report

__all__ = ["facts_of", "is_finished", "whole_report"]


def whole_report(folder: Path) -> Report | None:
    """Read the report of a folder whose files are all there, as they were written; None of any other."""
    try:
        manifest = read_manifest(folder)
        if manifest is None or REPORT not in manifest.files or stranger(folder, manifest) is not None:
            return None
        if not all((folder / name).is_file() for name in manifest.files):
            return None
        return read_report(folder / REPORT)
    except (OSError, InputError):
        return None


def is_finished(report: Report, sha256: str, options: dict[str, object], version: str) -> bool:
    """Tell whether a puzzle was made of this very file, with these options, by this version."""
    given = report.get("input")
    told = report.get("options")
    if not (isinstance(given, dict) and isinstance(told, dict)):
        return False
    same = {name: told.get(name, ...) for name in options} == options
    return same and given.get("sha256") == sha256 and report.get("meshjig") == version


def facts_of(report: Report, record: Record) -> Record:
    """Give a record with what the report of a puzzle says.

    Raises
    ------
    KeyError, TypeError, ValueError
        It is no report of a puzzle.
    """
    from dataclasses import replace

    broken = tuple(str(name) for name in report["failures"])
    return replace(
        record,
        outcome=BROKEN if broken else MADE,
        exit=3 if broken else 0,
        pieces=len(report["pieces"]),
        size_mm=tuple(float(x) for x in report["input"]["size_mm"]),
        faces=int(report["input"]["faces"]),
        broken=broken,
        shows=tuple(name for name in ("viewer.html", "guide.pdf") if name in report["files"]),
    )
