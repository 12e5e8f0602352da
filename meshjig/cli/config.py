"""Options from a file and from flags."""

from __future__ import annotations

import os
import tomllib
from pathlib import Path
from typing import Any

import typer

from meshjig.cli.terminal import USAGE, say
from meshjig.errors import OptionError
from meshjig.options import Options
from meshjig.runtime.bounded import Bounded, Limits, OutOfBounds

__all__ = ["parse_toml", "read_options"]

_LIMITS = Limits(memory=200e6, seconds=3.0)


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
            from meshjig.pipeline.preflight import refuse_unknown_names

            refuse_unknown_names(options)
        return options
    except OptionError as error:
        say(f"meshjig: {error}")
        raise typer.Exit(USAGE) from None


def _read_toml(path: Path) -> dict[str, Any]:
    try:
        return Bounded(__name__, "parse_toml", str(path), limits=_LIMITS).result()
    except OutOfBounds as error:
        raise OptionError(f"config: {path} {error}", hint="look through it") from None


def parse_toml(name: str) -> dict[str, Any]:
    """Parse a TOML file.

    Raises
    ------
    OptionError
        It can't be read, or is no TOML.
    """
    path = Path(name)
    try:
        if os.path.lexists(path) and not path.is_file():
            raise OptionError(f"config: {path} is no file")
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise OptionError(f"config: {path} can't be read ({error.strerror})") from None
    except RecursionError:
        raise OptionError(f"config: {path} is nested too deeply") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise OptionError(f"config: {path} is no valid TOML ({error})") from None
    except ValueError:
        raise OptionError(f"config: {path} holds a number of too many digits") from None
