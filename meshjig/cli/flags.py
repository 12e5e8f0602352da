"""Command-line flags made of the options, so that no option is written down twice."""

from __future__ import annotations

import functools
import inspect
import typing
from collections.abc import Callable
from typing import Annotated, Any, Literal

import typer

from meshjig.options import Options

__all__ = ["flag", "takes_options"]

Command = Callable[..., None]


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
