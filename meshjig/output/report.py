"""The report: what was made, what was measured, as JSON."""

from __future__ import annotations

import errno
import json
import math
import stat
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError

__all__ = [
    "Expectations",
    "Report",
    "read_expectations",
    "read_missing",
    "read_report",
    "report_file",
    "report_text",
    "title_of",
    "write_report",
]


Report = dict[str, Any]  # what report.json holds
_DIGITS = 7
_MOST_PARTS = 10_000  # of a core
_LARGEST = 16_000_000  # bytes; reports of 10,000 pieces have a third of it


def report_file(path: Path) -> str:
    """Give the text of a report.

    Raises
    ------
    OSError
        It can't be read, or is no regular file.
    ValueError
        It is larger than any report, or no text.
    """
    found = path.stat()
    if not stat.S_ISREG(found.st_mode):
        raise OSError(errno.EINVAL, "no regular file", str(path))
    if found.st_size > _LARGEST:
        raise ValueError("larger than any report")
    return path.read_text(encoding="utf-8")


def read_report(path: Path) -> Report:
    """Read the report of a folder that meshjig made.

    Raises
    ------
    InputError
        There is none, or it is damaged.
    """
    try:
        report = json.loads(report_file(path))
    except OSError as error:
        raise InputError(f"{path} can't be read ({(error.strerror or str(error)).lower()})") from None
    except (ValueError, RecursionError):
        raise InputError(f"{path} is no valid JSON, or damaged", hint=_HINT) from None
    if not isinstance(report, dict):
        raise InputError(f"{path} is no report of meshjig", hint=_HINT)
    return report


_HINT = "make the puzzle again, or remove it to judge the pieces by themselves"


def write_report(path: Path, report: Mapping[str, Any]) -> None:
    """Write a report as JSON, its keys in the order given; see ``report_text``."""
    path.write_text(report_text(report), encoding="utf-8")


def title_of(report: Mapping[str, Any]) -> str:
    """Give the name of the model's file, or Puzzle."""
    name = report.get("input", {}).get("file")
    return _encodable(Path(str(name)).stem) if name else "Puzzle"


def report_text(report: Mapping[str, Any]) -> str:
    """Give a report as JSON text.

    Parameters
    ----------
    report : mapping
        Numpy numbers and arrays, paths, tuples and sets are welcome.

    Returns
    -------
    str
        Keys in the order given; floats with seven significant digits; what is not finite is null, since
        it was not measured.
    """
    return json.dumps(_plain(report), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, set | frozenset):
        return [_plain(item) for item in sorted(value)]
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None
    if value is None or isinstance(value, bool | int):
        return value
    return _encodable(str(value))


def _encodable(text: str) -> str:
    """Escape what is no text: bytes of a file's name that are no UTF-8."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


class Expectations(NamedTuple):
    """What the judgement of finished pieces may know beforehand; None for what is not known."""

    neighbours: list[tuple[int, int]] | None = None  # indices of pieces that share a border
    thickness: float | None = None  # mm
    clearance: float | None = None  # mm
    min_wall: float | None = None  # mm
    exempt_pieces: tuple[str, ...] = ()  # names of pieces affected by crossings of the model itself
    through_pieces: tuple[str, ...] = ()  # names of pieces that reach through a thin part
    model_thin: Mapping[str, float] = {}  # piece: share of its sheets that is thin because the model is
    assembly: Mapping[str, Any] | None = None  # order, way, shift, give and laid_out, as check takes them


def read_expectations(report: Mapping[str, Any] | None, names: Sequence[str]) -> Expectations:
    """Read what the report in a folder of pieces says was asked for.

    Nothing that was measured of the pieces is taken from it, but where the model itself is thin.

    Parameters
    ----------
    report : mapping, or None where there is none
    names : names of the pieces that were read

    Returns
    -------
    Expectations

    Raises
    ------
    InputError
        The report is damaged.
    """
    if report is None:
        return Expectations()
    try:
        options, through = report["options"], report.get("through", {})
        return Expectations(
            _neighbours(report["pieces"], names),
            thickness=_length(options.get("thickness")),
            clearance=_length(options.get("clearance")),
            min_wall=_length(options.get("min_wall")),
            exempt_pieces=tuple(str(name) for name in report.get("exempt_pieces", ())),
            through_pieces=tuple(str(name) for name in through.get("pieces", ())),
            model_thin={str(name): _share(x) for name, x in through.get("model_thin", {}).items()},
            assembly=_assembly(report.get("assembly")),
        )
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError):
        raise _damaged() from None


def _damaged() -> InputError:
    return InputError(
        "report.json is no report of meshjig, or damaged", hint="remove it to judge the pieces by themselves"
    )


def read_missing(report: Mapping[str, Any] | None, names: Sequence[str]) -> list[str]:
    """List what the report in a folder of pieces tells of, and no file holds.

    Parameters
    ----------
    report : mapping, or None where there is none
    names : names of the pieces, and parts of the core, that were read

    Raises
    ------
    InputError
        The report is damaged.
    """
    if report is None:
        return []
    try:
        listed = [f"piece_{piece['id']:03d}" for piece in report["pieces"]]
        parts = range(report.get("core", {}).get("parts", 0))
    except (ValueError, KeyError, TypeError, AttributeError):
        raise _damaged() from None
    if len(parts) > _MOST_PARTS:
        raise _damaged()
    if not set(listed) & set(names):
        return []  # the pieces go by other names
    return sorted({*listed, *(f"core_{i + 1}" for i in parts)} - set(names))


def _length(value: Any) -> float | None:
    """Give a length in mm, or None where there is none; a ValueError where it is none."""
    if value is None:
        return None
    if isinstance(value, bool | str) or not 0 <= float(value) < math.inf:
        raise ValueError(value)
    return float(value)


def _assembly(told: Any) -> dict[str, Any] | None:
    """Give the order of pieces by name, and how each goes in; None where none was planned."""
    if told is None:
        return None
    names = {str(i): f"piece_{int(i):03d}" for i in told["order"]}
    motions = {names[str(i)]: motion for i, motion in told["motions"].items()}
    return {
        "order": list(names.values()),
        "way": {name: _vector(motion["axis"]) for name, motion in motions.items()},
        "shift": {name: _vector(motion["shift"]) for name, motion in motions.items()},
        "give": _length(told["give_mm"]) or 0.0,
        "laid_out": {names[str(i)]: _length(mm3) or 0.0 for i, mm3 in told["laid_out_mm3"].items()},
    }


def _vector(value: Any) -> list[float]:
    """Give three numbers; a ValueError where there are others."""
    x = [float(number) for number in value]
    if len(x) != 3 or not all(map(math.isfinite, x)):
        raise ValueError(value)
    return x


def _share(value: Any) -> float:
    """Give a share, 0 to 1; a ValueError where it is none."""
    if isinstance(value, bool | str) or not 0 <= float(value) <= 1:
        raise ValueError(value)
    return float(value)


def _neighbours(pieces: list[Report], names: Sequence[str]) -> list[tuple[int, int]] | None:
    """The pairs of pieces that are both there, or None where no piece goes by its number."""
    place = {name: i for i, name in enumerate(names)}
    at = {piece["id"]: place.get(f"piece_{piece['id']:03d}") for piece in pieces}
    if all(i is None for i in at.values()):
        return None
    pairs = ((at[piece["id"]], at.get(other)) for piece in pieces for other in piece["neighbours"])
    return sorted({(i, j) for i, j in pairs if i is not None and j is not None and i < j})
