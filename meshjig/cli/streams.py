"""Standard output and standard error, kept for what meshjig itself has to say."""

from __future__ import annotations

import logging
import os
import sys
import warnings
from contextlib import suppress
from typing import TextIO

from meshjig.errors import printable, write_error
from meshjig.runtime.messages import folders_written, lasting, tell

__all__ = ["ask_libraries_to_be_quiet", "emit", "error_stream", "outcome", "say", "set_verbosity"]

_kept: dict[str, TextIO] = {}  # streams of ours; without them, those of the interpreter


class _Printable(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        """Escape what is somebody else's text; only a traceback has lines."""
        return "\n".join(map(printable, super().format(record).split("\n")))


def set_verbosity(verbose: bool, quiet: bool, libraries: bool = False) -> None:
    """Choose what is logged on standard error; libraries print only if they may, or with verbose."""
    if not (verbose or libraries):
        ask_libraries_to_be_quiet()
    handler = logging.StreamHandler(error_stream())
    handler.setFormatter(_Printable("%(message)s"))
    logging.getLogger().handlers[:] = [handler if verbose else logging.NullHandler()]
    ours = logging.getLogger("meshjig")
    ours.handlers[:], ours.propagate = [handler], False
    ours.setLevel(logging.DEBUG if verbose else logging.ERROR if quiet else logging.WARNING)
    logging.getLogger("meshjig.told").setLevel(logging.ERROR if quiet else logging.INFO)


def ask_libraries_to_be_quiet() -> None:
    """Let whatever libraries print, in Python or in native code, go nowhere; ours goes on."""
    warnings.simplefilter("ignore")
    if _kept:
        return
    with suppress(OSError, ValueError, AttributeError):
        for name, number in (("out", 1), ("error", 2)):
            stream = sys.stdout if name == "out" else sys.stderr
            stream.flush()
            own = os.dup(number)
            _kept[name] = os.fdopen(own, "w", encoding=stream.encoding, errors="backslashreplace")
        nowhere = os.open(os.devnull, os.O_WRONLY)
        for number in (1, 2):
            os.dup2(nowhere, number)
        os.close(nowhere)
        sys.stdout = sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115


def error_stream() -> TextIO | None:
    """Give the stream to print sentences and progress to."""
    return _kept.get("error", sys.stderr)


def say(sentence: str) -> None:
    """Print to standard error, if somebody listens there; what moves a terminal's cursor is escaped."""
    with suppress(OSError, ValueError, AttributeError):  # full or closed; it is no reason to end
        print(printable(sentence), file=error_stream(), flush=True)


def emit(text: str) -> None:
    """Print a result to standard output.

    Raises
    ------
    OutputError, ResourceError
        It can't be written. A reader that has gone away is none of our business.
    """
    tell("answered", 1)
    stream = _kept.get("out", sys.stdout)
    try:
        print(text, file=stream, flush=True)
    except BrokenPipeError:
        _close(stream)
    except (OSError, ValueError) as error:
        _close(stream)
        failure = write_error("standard output", error)
        raise type(failure)(f"{failure.message}; {outcome()}") from None


def outcome() -> str:
    """Say what this run has written, after a sentence on why it ends."""
    folders = folders_written()
    if lasting():
        return lasting()
    return f"{', '.join(folders)} is whole" if folders else "nothing was written"


def _close(stream: TextIO) -> None:
    """Let what is still to be printed go nowhere."""
    with suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
