"""Facts as lines of text, for people; programs have JSON, in which nothing is rounded."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from meshjig.errors import printable

__all__ = ["as_lines"]

_DIGITS = 4


def as_lines(facts: Mapping[str, Any], missing: str = "no", indent: str = "") -> str:
    """Write facts, a line each.

    Parameters
    ----------
    facts : mapping
        Mappings in it are indented.
    missing : str
        What stands for None: "no" where something was not done, "not measured" where that is true.
    indent : str
    """
    lines = []
    for key, value in facts.items():
        if isinstance(value, Mapping) and value:
            lines += [f"{indent}{key}:", as_lines(value, missing, indent + "  ")]
        else:
            lines.append(f"{indent}{key}: {_shown(value, missing)}")
    return "\n".join(lines)


def _shown(value: Any, missing: str) -> str:
    if value is None:
        return missing
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return _rounded(value)
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {_shown(item, missing)}" for key, item in value.items()) or "none"
    if isinstance(value, Sequence) and not isinstance(value, str):
        parts = [_shown(item, missing) for item in value]
        return "; ".join(parts) if any("," in part for part in parts) else ", ".join(parts) or "none"
    return printable(str(value))


def _rounded(value: float) -> str:
    """Give a number with four digits that count, and without an exponent where it can be read so."""
    if not math.isfinite(value) or value == 0 or not 1e-5 <= abs(value) < 1e15:
        return f"{value:.{_DIGITS}g}"
    decimals = _DIGITS - 1 - math.floor(math.log10(abs(value)))
    text = f"{round(value, decimals):.{max(decimals, 0)}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text
