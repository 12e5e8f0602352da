"""Options from a file and from flags."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import typer

from meshjig.errors import OptionError
from meshjig.options import Options
from meshjig.terminal import USAGE, say

__all__ = ["read_options"]


def read_options(config: Path | None, flags: dict[str, Any]) -> Options:
    """Make options of a TOML file, if one is given, and flags, which win; wrong ones end the command."""
    given: dict[str, Any] = {}
    try:
        if config is not None:
            given = {key.replace("-", "_"): value for key, value in _read_toml(config).items()}
            if isinstance(given.get("process"), dict):  # [process.NAME], chosen by --process
                given["processes"] = given.pop("process")
        options = Options.of(**given | flags)
        if {"tile", "plate"} & (given.keys() | flags.keys()):
            from meshjig.refusals import refuse_unknown_names

            refuse_unknown_names(options)
        return options
    except OptionError as error:
        say(f"meshjig: {error}")
        raise typer.Exit(USAGE) from None


def _read_toml(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise OptionError(f"config: {path} can't be read ({error.strerror})") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise OptionError(f"config: {path} is no valid TOML ({error})") from None
