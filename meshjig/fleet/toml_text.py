"""Options as the text of a TOML file."""

from __future__ import annotations

import json
from collections.abc import Mapping

__all__ = ["toml_text"]


def toml_text(given: Mapping[str, object]) -> str:
    """Write options, and tables of them; None is left out.

    Parameters
    ----------
    given : mapping of str to None, bool, int, float, str, list or tuple of str, or mapping of these
    """
    lines = [f"{_key(name)} = {_value(value)}" for name, value in given.items() if _is_plain(value)]
    tables = {name: table for name, table in given.items() if isinstance(table, Mapping)}
    for name, table in tables.items():
        for inner, fields in table.items():
            lines += ["", f"[{_key(name)}.{_key(inner)}]"]
            lines += [f"{_key(key)} = {_value(value)}" for key, value in fields.items() if value is not None]
    return "\n".join(lines) + "\n"


def _is_plain(value: object) -> bool:
    return value is not None and not isinstance(value, Mapping)


def _key(name: str) -> str:
    return _text(name)


def _value(value: object) -> str:
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, str):
        return _text(value)
    return repr(value) if isinstance(value, float) else json.dumps(value)  # TOML has inf and nan, as Python


def _text(value: str) -> str:
    """Quote as JSON does, without its pairs of surrogates, and with what TOML refuses besides."""
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
