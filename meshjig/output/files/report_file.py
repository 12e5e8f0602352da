"""The report: what was made, what was measured, as JSON."""

import errno
import json
import math
import stat
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError

__all__ = ["read_report", "report_file", "report_text", "write_report"]

_DIGITS = 7
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


def read_report(path: Path) -> dict[str, Any]:
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
    if value is None or isinstance(value, bool | int | str):
        return value
    return str(value)
