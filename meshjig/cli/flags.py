"""Flags of commands, made of the options themselves."""

from __future__ import annotations

import functools
import inspect
import re
import typing
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from meshjig.option_errors import choices, spelling
from meshjig.options import PROCESSES, Options

__all__ = ["AsJson", "Config", "Flags", "Quiet", "Verbose", "flag", "takes_options"]

Flags = dict[str, Any]  # options by their names, those that were given

Config = Annotated[
    Path | None, typer.Option("--config", metavar="FILE.toml", help="read options from a TOML file")
]
AsJson = Annotated[
    bool, typer.Option("--json", help="print the result, or the failure, as JSON on standard output")
]
Verbose = Annotated[bool, typer.Option("--verbose", "-v", help="say more")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="say nothing but errors")]

Command = Callable[..., None]


def flag(name: str) -> Any:
    """Give the annotation of the flag for a field of Options; None where it is not given.

    Values stay text: `Options` reads them, as it reads those of files.
    """
    field = Options.model_fields[name]
    switch = field.annotation is bool
    words = f"--{spelling(name)}" + f"/--no-{spelling(name)}" * switch
    option = typer.Option(
        words, metavar=_metavar(field), help=f"{field.description}{_default(name)}", show_default=False
    )
    return Annotated[(bool if switch else str) | None, option]


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


def _metavar(field: Any) -> str:
    """Say what values there are: words, a length in MM, another number X, a whole one N."""
    kinds, words = _types_in(field.annotation), choices(field.annotation)
    number = next(
        (name for name in ("MM", "GB") if re.search(rf"\b{name}\b", field.description or "", re.I)), "X"
    )
    numbers = [number] if float in kinds else ["N"] if int in kinds else []
    if typing.get_origin(field.annotation) is tuple:
        return ",".join(words)
    return "|".join([*numbers, *words]) or ("" if bool in kinds else "NAME")


def _default(name: str) -> str:
    """Say in brackets what holds where a flag is not given; nothing where its description does."""
    by_process = {process: preset[name] for process, preset in PROCESSES.items() if name in preset}
    if by_process:
        return f" (default: {', '.join(f'{process} {value:g}' for process, value in by_process.items())})"
    value = Options.model_fields[name].default
    if value is None or value is False:
        return ""
    shown = "on" if value is True else ",".join(value) if isinstance(value, tuple) else value
    return f" (default: {shown:g})" if isinstance(shown, float) else f" (default: {shown})"


def _types_in(annotation: Any) -> set[type]:
    if isinstance(annotation, type) and not typing.get_args(annotation):
        return {annotation}
    if typing.get_origin(annotation) is Literal:
        return {str}
    return set().union(*(_types_in(part) for part in typing.get_args(annotation)))
