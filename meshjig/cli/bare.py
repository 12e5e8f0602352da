"""Flags that may stand without a value: what they mean then is written after them."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import zip_longest

from meshjig.options import Options

__all__ = ["with_values"]


def with_values(words: Sequence[str]) -> list[str]:
    """Give the words of a command line, with a value after each flag that stands alone but means one.

    A number or that value itself is what a user gives; whatever else follows is not the flag's.
    """
    alone = {
        "--" + name.replace("_", "-"): str(field.json_schema_extra["alone"])
        for name, field in Options.model_fields.items()
        if isinstance(field.json_schema_extra, dict) and "alone" in field.json_schema_extra
    }
    filled = []
    for word, after in zip_longest(words, words[1:]):
        filled.append(word)
        if word in alone and after != alone[word] and not _is_number(after):
            filled.append(alone[word])
    return filled


def _is_number(word: str | None) -> bool:
    with suppress(ValueError):
        return word is not None and float(word) == float(word)
    return False
