"""Options from flags, which are made of the options themselves, and from a file."""

from __future__ import annotations

import functools
import inspect
import os
import tomllib
import typing
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from meshjig.cli.terminal import USAGE, say
from meshjig.errors import OptionError
from meshjig.options import Options
from meshjig.runtime.bounded import Bounded, Limits, OutOfBounds

__all__ = ["Flags", "flag", "parse_toml", "read_options", "takes_options"]

Flags = dict[str, Any]  # options by their names, those that were given

Command = Callable[..., None]

_LIMITS = Limits(memory=200e6, seconds=3.0)


def read_options(config: Path | None, flags: Flags) -> Options:
    """Make options of a TOML file, if one is given, and flags, which win; wrong ones end the command."""
    given: Flags = {}
    try:
        if config is not None:
            given = {key.replace("-", "_"): value for key, value in _read_toml(config).items()}
            if isinstance(given.get("process"), dict):  # [process.NAME], chosen by --process
                given["processes"] = given.pop("process")
        options = Options.of(**given | flags)
        if {"tile", "plate"} & (given.keys() | flags.keys()):
            from meshjig.pipeline.preflight import refuse_unknown_names

            refuse_unknown_names(options)
        return options
    except OptionError as error:
        say(f"meshjig: {error}")
        raise typer.Exit(USAGE) from None


def _read_toml(path: Path) -> Flags:
    try:
        return Bounded(__name__, "parse_toml", str(path), limits=_LIMITS).result()
    except OutOfBounds as error:
        raise OptionError(f"config: {path} {error}", hint="look through it") from None


def parse_toml(name: str) -> Flags:
    """Parse a TOML file.

    Raises
    ------
    OptionError
        It can't be read, or is no TOML.
    """
    path = Path(name)
    if os.path.lexists(path) and not path.is_file():
        raise OptionError(f"config: {path} is no file")
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise OptionError(f"config: {path} can't be read ({error.strerror})") from None
    except RecursionError:
        raise OptionError(f"config: {path} is nested too deeply") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise OptionError(f"config: {path} is no valid TOML ({error})") from None
    except ValueError:
        raise OptionError(f"config: {path} holds a number of too many digits") from None


def flag(name: str) -> Any:
    """Give the annotation of the flag for a field of Options; None where it is not given."""
    field = Options.model_fields[name]
    spelling = "--" + name.replace("_", "-")
    kind = _kind(field.annotation)
    if kind is bool:
        spelling += f"/--no-{spelling[2:]}"
    return Annotated[kind | None, typer.Option(spelling, help=field.description, show_default=False)]


def takes_options(*names: str) -> Callable[[Command], Command]:
    """Give a command flags for options, all of them if none is named.

    The command gets those that a user gave as the dict ``flags``.
    """

    def with_flags(command: Command) -> Command:
        chosen = names or tuple(Options.model_fields)
        hints = typing.get_type_hints(command, include_extras=True)
        own = {k: p for k, p in inspect.signature(command).parameters.items() if k != "flags"}
        annotations = {name: hints[name] for name in own} | {name: flag(name) for name in chosen}
        defaults = {name: p.default for name, p in own.items()} | dict.fromkeys(chosen)

        @functools.wraps(command)
        def run(**given: Any) -> None:
            flags = {name: given.pop(name) for name in chosen}
            command(flags={name: value for name, value in flags.items() if value is not None}, **given)

        run.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
            [
                inspect.Parameter(
                    name, inspect.Parameter.KEYWORD_ONLY, default=defaults[name], annotation=annotation
                )
                for name, annotation in annotations.items()
            ]
        )
        run.__annotations__ = annotations
        return run

    return with_flags


def _kind(annotation: Any) -> type:
    """Give the type that a flag's value has on the command line."""
    found = _types_in(annotation)
    return next((kind for kind in (bool, str, float) if kind in found), int)


def _types_in(annotation: Any) -> set[type]:
    if isinstance(annotation, type) and not typing.get_args(annotation):
        return {annotation}
    if typing.get_origin(annotation) in (Literal, tuple):
        return {str}
    return set().union(*(_types_in(part) for part in typing.get_args(annotation)))
