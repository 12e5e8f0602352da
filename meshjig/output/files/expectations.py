"""What a folder's report says was asked for, and who borders on whom: what pieces alone don't tell."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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


def read_asked(report: Mapping[str, Any] | None, names: Sequence[str]) -> Asked:
    """Read what the report in a folder of pieces says was asked for.

    Nothing that was measured is taken from it.

    Parameters
    ----------
    report : mapping, or None where there is none
    names : names of the pieces that were read

    Returns
    -------
    Asked

    Raises
    ------
    InputError
        The report is damaged.
    """
    if report is None:
        return Asked()
    try:
        options = report["options"]
        return Asked(
            _neighbours(report["pieces"], names),
            thickness=options.get("thickness"),
            clearance=options.get("clearance"),
            min_wall=options.get("min_wall"),
            exempt_pieces=tuple(report.get("exempt_pieces", ())),
        )
    except (ValueError, KeyError, TypeError, AttributeError):
        raise InputError(
            "report.json is no report of meshjig, or damaged",
            hint="remove it to judge the pieces by themselves",
        ) from None


def read_missing(report: Mapping[str, Any] | None, names: Sequence[str]) -> list[str]:
    """List what the report in a folder of pieces tells of, and no file holds.

    Parameters
    ----------
    report : mapping, or None where there is none
    names : names of the pieces, and parts of the core, that were read
    """
    if report is None:
        return []
    listed = [f"piece_{piece['id']:03d}" for piece in report["pieces"]]
    if not set(listed) & set(names):
        return []  # the pieces go by other names
    listed += [f"core_{i + 1}" for i in range(report.get("core", {}).get("parts", 0))]
    return sorted(set(listed) - set(names))


def _neighbours(pieces: list[dict[str, Any]], names: Sequence[str]) -> list[tuple[int, int]] | None:
    """Give the pairs of pieces that are both there, or None where no piece goes by its number."""
    place = {name: i for i, name in enumerate(names)}
    at = {piece["id"]: place.get(f"piece_{piece['id']:03d}") for piece in pieces}
    if all(i is None for i in at.values()):
        return None
    pairs = ((at[piece["id"]], at.get(other)) for piece in pieces for other in piece["neighbours"])
    return sorted({(i, j) for i, j in pairs if i is not None and j is not None and i < j})
