"""The report: what was made, what was measured, as JSON."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

__all__ = ["report_text", "write_report"]

_DIGITS = 7


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
