"""Sentences about options that are wrong, in place of those of pydantic."""

from __future__ import annotations

import re
import typing
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

from pydantic_core import PydanticCustomError

from meshjig.errors import OptionError, did_you_mean

__all__ = ["choices", "option_error", "refused", "shown_value", "spelling"]

REFUSED = "refused"
_LONGEST = 40  # characters of a value that are shown
_MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "inch": 25.4, '"': 25.4}
_MEASURE = re.compile(r"([-+]?\d+(?:[.,]\d+)?)\s*([a-zA-Z\"]*|%|°)")
_GROUPED = re.compile(r"\d{1,3}(?:[ ,'._]\d{3})+")
_BOUNDS = {"greater_than": "gt", "greater_than_equal": "ge", "less_than": "lt", "less_than_equal": "le"}
_WORDS = {"gt": "more than", "ge": "at least", "lt": "less than", "le": "at most"}
_NO_NUMBER = {"int_parsing", "int_type", "int_from_float", "float_parsing", "float_type"}


def option_error(errors: Sequence[Mapping[str, Any]], fields: Mapping[str, Any]) -> OptionError:
    """Give the error about the first of the options that pydantic refuses.

    Parameters
    ----------
    errors : what ``ValidationError.errors`` gives, at least one
    fields : mapping of str to pydantic.fields.FieldInfo, by the names of the options

    Returns
    -------
    OptionError
        Its sentence begins with the option's spelling.
    """
    first = errors[0]
    if first["type"] == REFUSED:
        name, hint = first["ctx"]["option"], first["ctx"]["hint"]
        return OptionError(f"{spelling(name)}: {first['msg']}", hint=hint, option=name)
    if not first["loc"]:
        return OptionError(first["msg"].removeprefix("Value error, "))
    name = str(first["loc"][0])
    if first["type"] == "extra_forbidden":
        hint = did_you_mean(spelling(name), map(spelling, fields)) or "meshjig make --help lists them"
        hint = "options stand in no table" if isinstance(first["input"], dict) else hint
        return OptionError(f"{spelling(name)}: there is no such option", hint=hint, option=name)
    same = [error for error in errors if error["loc"][0] == name]
    says, hint = _refusal(same, fields[name])
    return OptionError(f"{spelling(name)}: {says}", hint=hint, option=name)


def refused(option: str, says: str, hint: str = "") -> PydanticCustomError:
    """Give what a validator of options raises in order to refuse one of them."""
    return PydanticCustomError(REFUSED, "{says}", {"says": says, "hint": hint, "option": option})


def spelling(name: str) -> str:
    """Give an option's name as it is written in files and, after two hyphens, as a flag."""
    return name.replace("_", "-")


def shown_value(value: Any) -> str:
    """Give a value as its user wrote it, if that is short."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, list | tuple):
        return "a list"
    if isinstance(value, int) and abs(value) >= 10**_LONGEST:
        return "a number of too many digits"
    text = f"{value:g}" if isinstance(value, float) else repr(value)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}...{text[-1]}"


def choices(annotation: Any) -> list[str]:
    """List the words that a field's annotation names, in its order."""
    if typing.get_origin(annotation) is Literal:
        return [str(value) for value in typing.get_args(annotation)]
    return [word for part in typing.get_args(annotation) for word in choices(part)]


def _refusal(errors: Sequence[Mapping[str, Any]], field: Any) -> tuple[str, str]:
    """Say what is wrong with a value, and what to do about it."""
    kinds = {error["type"]: error for error in errors}
    shown, words = shown_value(errors[0]["input"]), choices(field.annotation)
    whole = any(kind.startswith("int") for kind in kinds)
    bound = next((kind for kind in _BOUNDS if kind in kinds), "")
    if bound:
        key = _BOUNDS[bound]
        also = f", or {_either(words)}" if words else ""
        size = "too small" if key in ("gt", "ge") else "too large"
        limit = kinds[bound]["ctx"][key]
        return (
            f"{shown} is {size}",
            f"give {_WORDS[key]} {limit if isinstance(limit, int) else f'{limit:g}'}{also}",
        )
    if "literal_error" in kinds:
        near = did_you_mean(str(errors[0]["input"]), words)
        if _NO_NUMBER & kinds.keys():
            says = f"{shown} is neither a {'whole ' * whole}number nor {' nor '.join(words)}"
            return says, near or _as_number(errors[0]["input"], whole, field)
        return f"{shown} is none of {', '.join(words)}", near
    if _NO_NUMBER & kinds.keys():
        return f"{shown} is no {'whole ' * whole}number", _as_number(errors[0]["input"], whole, field)
    if "bool_parsing" in kinds or "bool_type" in kinds:
        return f"{shown} is neither true nor false", ""
    if "string_type" in kinds:
        return f"{shown} is no text", "put it in quotes"
    if "finite_number" in kinds or "int_parsing_size" in kinds:
        return f"{shown} is too large, or no number", ""
    if "too_short" in kinds:
        return "at least one is needed", f"known are {', '.join(words)}" if words else ""
    says = errors[0]["msg"]
    return f"{shown} is refused ({says[:1].lower()}{says[1:]})", ""


def _as_number(value: Any, whole: bool, field: Any) -> str:
    """Say how a number is written, where a user wrote one in another way."""
    text = str(value).strip()
    if whole and _GROUPED.fullmatch(text):
        return f"write {re.sub('[^0-9]', '', text)}"
    found = _MEASURE.fullmatch(text)
    if found is None:
        return ""
    number, unit = float(found[1].replace(",", ".")), found[2].lower()
    if unit == "k":
        return f"write {1000 * number:.0f}"
    if whole:
        return ""
    if unit == "%":
        return f"write {number / 100:g}"
    if unit in _MILLIMETRES and "mm" in re.findall("[a-z]+", field.description or ""):
        return f"lengths are in mm, so write {number * _MILLIMETRES[unit]:g}"
    return f"write {number:g}" if unit in ("", "deg", "degrees", "°", "gb") else ""


def _either(words: Iterable[str]) -> str:
    return " or ".join(repr(word) for word in words)
