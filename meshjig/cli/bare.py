"""Flags that may stand without a value: what they mean then is written after them."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import zip_longest

from meshjig.options import Options

__all__ = ["with_values"]


def with_values(words: Sequence[str]) -> list[str]:
    """Give the words of a command line, with a value after each flag that stands alone but means one.

    The name of a file, or another flag, that follows is not the flag's. Any other word is its value, which is
    refused later where it is none.
    """
    alone = {
        "--" + name.replace("_", "-"): str(field.json_schema_extra["alone"])
        for name, field in Options.model_fields.items()
        if isinstance(field.json_schema_extra, dict) and "alone" in field.json_schema_extra
    }
    filled = []
    for word, after in zip_longest(words, words[1:]):
        filled.append(word)
        if word in alone and not _may_be_value(after):
            filled.append(alone[word])
    return filled


def _may_be_value(word: str | None) -> bool:
    if word is None:
        return False
    with suppress(ValueError):
        float(word)
        return True
    return not word.startswith("-") and "." not in word and "/" not in word
