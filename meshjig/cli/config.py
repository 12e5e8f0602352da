"""Options from flags and from a file."""

from __future__ import annotations

import codecs
import os
import tomllib
from collections.abc import Mapping
from pathlib import Path

from meshjig.cli.flags import Flags
from meshjig.errors import OptionError
from meshjig.option_errors import spelling
from meshjig.options import EITHER, Options
from meshjig.runtime.bounded import Bounded, Limits, OutOfBounds

__all__ = ["parse_toml", "read_given", "read_options"]

_EXAMPLE = 'a line of it is such as pieces = 30, or join = "round"'
_LIMITS = Limits(memory=200e6, seconds=3.0)


def read_options(config: Path | None, flags: Flags, spelt: Mapping[str, str] | None = None) -> Options:
    """Make options of a TOML file, if one is given, and flags, which win.

    Parameters
    ----------
    config : Path or None
    flags : dict, options by their names
    spelt : mapping, optional
        The flags of options that go by another name than theirs.

    Returns
    -------
    Options

    Raises
    ------
    OptionError
        An option is wrong, or the file is; the sentence names the flag, or the file and its key.
    """
    return Options.of(**read_given(config, flags, spelt))


def read_given(config: Path | None, flags: Flags, spelt: Mapping[str, str] | None = None) -> Flags:
    """Give the options of a TOML file and of flags that are no defaults, once they are known to be right.

    Parameters and errors are those of `read_options`.
    """
    given: Flags = {}
    if config is not None:
        given = {key.replace("-", "_"): value for key, value in _read_toml(config).items()}
        if isinstance(given.get("process"), dict):  # [process.NAME], chosen by --process
            given["processes"] = given.pop("process")
    given = {key: value for key, value in given.items() if EITHER.get(key) not in flags}
    try:
        options = Options.of(**given | flags)
        if {"tile", "plate"} & (given.keys() | flags.keys()):
            from meshjig.pipeline.preflight import refuse_unknown_names

            refuse_unknown_names(options)
    except OptionError as error:
        raise _located(error, config, flags, spelt or {}) from None
    return given | flags


def _located(error: OptionError, config: Path | None, flags: Flags, spelt: Mapping[str, str]) -> OptionError:
    """Say whether a wrong option came from a flag or from the file."""
    if not error.option:
        return error
    if error.option not in flags and config is not None:
        return OptionError(f"{config}: {error.message}", hint=error.hint)
    flag = spelt.get(error.option, spelling(error.option))
    return OptionError(f"--{flag}: {error.message.partition(': ')[2]}", hint=error.hint)


def _read_toml(path: Path) -> Flags:
    try:
        return Bounded(__name__, "parse_toml", str(path), limits=_LIMITS).result()
    except OutOfBounds as error:
        raise OptionError(f"--config: {path} {error}", hint="look through it") from None


def parse_toml(name: str) -> Flags:
    """Parse a TOML file.

    Raises
    ------
    OptionError
        It can't be read, or is no TOML.
    """
    path = Path(name)
    if not os.path.lexists(path):
        raise OptionError(f"--config: {path} does not exist", hint="check the name")
    if not path.is_file():
        raise OptionError(f"--config: {path} is no file")
    try:
        data = path.read_bytes()
        if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) or b"\0" in data[:2]:
            raise OptionError(f"--config: {path} is in UTF-16", hint="save it as UTF-8, which TOML asks for")
        return tomllib.loads(data.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n"))
    except OptionError:
        raise
    except OSError as error:
        raise OptionError(f"--config: {path} can't be read ({error.strerror})") from None
    except RecursionError:
        raise OptionError(f"--config: {path} is nested too deeply") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise OptionError(f"--config: {path} is no valid TOML ({error})", hint=_EXAMPLE) from None
    except ValueError:
        raise OptionError(f"--config: {path} holds a number of too many digits") from None
