"""Sentences about command lines that can't be understood, in place of those of the parser."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from meshjig.errors import OptionError, did_you_mean

__all__ = ["is_usage_error", "usage_error"]

_MESHES = {".stl", ".obj", ".ply", ".off", ".glb", ".gltf", ".3mf"}
_QUOTED = re.compile(r"'([^']*)'")


def is_usage_error(error: BaseException) -> bool:
    """Tell whether the parser of command lines refuses one."""
    return "UsageError" in _names(error)


def usage_error(error: Any, words: Sequence[str]) -> OptionError:
    """Say what is wrong with a command line, and what to do about it.

    Parameters
    ----------
    error : the parser's UsageError, typer's own or click's, which versions of typer differ in
    words : the command line, without the program's name
    """
    names, command = _names(error), getattr(getattr(error, "ctx", None), "command", None)
    path = f"meshjig {words[0]}" if words and words[0].isalpha() else "meshjig"
    said = error.format_message().strip().rstrip(".")
    if "NoSuchOption" in names:
        flags = {flag.lstrip("-"): flag for flag in _flags(command)}
        near = did_you_mean(error.option_name.lstrip("-"), flags, least=0.7)
        for word, flag in flags.items():
            near = near.replace(f" {word}?", f" {flag}?")
        return OptionError(
            f"there is no option {error.option_name}", hint=near or f"{path} --help lists those there are"
        )
    if "MissingParameter" in names:
        wanted = getattr(error.param, "metavar", None) or str(getattr(error.param, "name", "")).upper()
        example = f"{path} {_EXAMPLES.get(wanted, wanted)}"
        return OptionError(f"{path.removeprefix('meshjig ')} needs a {wanted}, such as {example}")
    if "BadOptionUsage" in names:
        needs = "takes no value" if "not take a value" in said else "needs a value"
        return OptionError(f"{error.option_name} {needs}", hint=f"see {path} --help")
    if "such command" in said:
        return _no_command(_QUOTED.findall(said)[0], getattr(command, "commands", {}))
    if "extra argument" in said:
        extra = said[said.rindex("(") + 1 :].rstrip(")")
        return OptionError(
            f"there is a word too many for {path}, {extra!r}", hint="put names that have spaces in quotes"
        )
    return OptionError(f"{said[:1].lower()}{said[1:]}", hint=f"see {path} --help")


_EXAMPLES = {"MESH": "scan.stl", "DIR": "scan-jigsaw", "DIR|FILES": "scan-jigsaw"}


def _no_command(word: str, commands: Iterable[str]) -> OptionError:
    commands = list(commands)
    if Path(word).suffix.lower() in _MESHES:
        hint = f"did you mean meshjig make {word}?"
    else:
        hint = did_you_mean(word, commands) or f"there are {', '.join(commands)}"
    return OptionError(f"there is no command {word}", hint=hint)


def _flags(command: Any) -> list[str]:
    """List the spellings of a command's flags."""
    parameters = getattr(command, "params", [])
    found = [flag for p in parameters for flag in (*p.opts, *p.secondary_opts) if flag.startswith("-")]
    return [*found, "--help"]


def _names(error: BaseException) -> set[str]:
    return {kind.__name__ for kind in type(error).__mro__}
