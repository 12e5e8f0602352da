"""What a folder's report says was asked for, and who borders on whom: what pieces alone don't tell."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from meshjig.errors import InputError

__all__ = ["Asked", "read_asked", "read_missing"]


class Asked(NamedTuple):
    """What the judgement of finished pieces may know beforehand; None for what is not known."""

    neighbours: list[tuple[int, int]] | None = None  # indices of pieces that share a border
    thickness: float | None = None  # mm
    clearance: float | None = None  # mm
    min_wall: float | None = None  # mm
    exempt_pieces: tuple[str, ...] = ()  # names of pieces touched by crossings of the model itself


def read_asked(
    paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], names: Sequence[str]
) -> Asked:
    """Read what the report in a folder of pieces says was asked for.

    Nothing that was measured is taken from it.

    Parameters
    ----------
    paths : path, or several
        As for `read_pieces`. Only a single folder that holds a report.json tells anything.
    names : names of the pieces that were read

    Returns
    -------
    Asked

    Raises
    ------
    InputError
        The report is damaged.
    """
    path = _report_in(paths)
    if path is None:
        return Asked()
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
        options = report["options"]
        return Asked(
            _neighbours(report["pieces"], names),
            thickness=options.get("thickness"),
            clearance=options.get("clearance"),
            min_wall=options.get("min_wall"),
            exempt_pieces=tuple(report.get("exempt_pieces", ())),
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        raise InputError(
            f"{path} is no report of meshjig, or damaged", hint="remove it to judge the pieces by themselves"
        ) from None


def read_missing(
    paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], names: Sequence[str]
) -> list[str]:
    """List what the report in a folder of pieces tells of, and no file holds.

    Parameters
    ----------
    paths : path, or several
        As for `read_pieces`. Only a single folder that holds a report.json tells anything.
    names : names of the pieces, and parts of the core, that were read
    """
    path = _report_in(paths)
    if path is None:
        return []
    report = json.loads(path.read_text(encoding="utf-8"))
    listed = [f"piece_{piece['id']:03d}" for piece in report["pieces"]]
    if not set(listed) & set(names):
        return []  # the pieces go by other names
    listed += [f"core_{i + 1}" for i in range(report.get("core", {}).get("parts", 0))]
    return sorted(set(listed) - set(names))


def _report_in(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]]) -> Path | None:
    given = [paths] if isinstance(paths, str | os.PathLike) else list(paths)
    path = Path(given[0]) / "report.json" if len(given) == 1 else Path()
    return path if path.is_file() else None


def _neighbours(pieces: list[dict[str, Any]], names: Sequence[str]) -> list[tuple[int, int]] | None:
    """Give the pairs of pieces that are both there, or None where no piece goes by its number."""
    place = {name: i for i, name in enumerate(names)}
    at = {piece["id"]: place.get(f"piece_{piece['id']:03d}") for piece in pieces}
    if all(i is None for i in at.values()):
        return None
    pairs = ((at[piece["id"]], at.get(other)) for piece in pieces for other in piece["neighbours"])
    return sorted({(i, j) for i, j in pairs if i is not None and j is not None and i < j})
