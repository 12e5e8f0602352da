"""A command line run to its end: whatever goes wrong becomes one sentence, one object and an exit code."""

from __future__ import annotations

import faulthandler
import io
import logging
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from typing import NoReturn

from meshjig.cli.bare import with_values
from meshjig.cli.endings import CUT_OFF, Ending, exit_code_of, wants_json
from meshjig.cli.streams import emit, error_stream, outcome, say
from meshjig.cli.usage import is_usage_error, usage_error
from meshjig.errors import MeshjigError
from meshjig.runtime.interpreter import end_with_parent
from meshjig.runtime.messages import stage_under_way, tell, tell_through

__all__ = ["exit_code", "run", "run_behind_front"]

_INTERRUPTED = CUT_OFF + 2  # SIGINT


def run(words: Sequence[str]) -> NoReturn:
    """Run the command line, and end the process.

    It ends at once: whatever libraries would still do on their way out can only fail by now.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    if {"-v", "--verbose"} & set(words):
        faulthandler.enable()
    code = exit_code(words)
    for open_stream in (sys.stdout, error_stream()):
        with suppress(OSError, ValueError, AttributeError):
            open_stream.flush()  # type: ignore[union-attr]
    tell("ended", code)
    os._exit(code)


def run_behind_front(front: str, pipe: str, *words: str) -> NoReturn:
    """Run the command line as the child of a process that ends it when asked to; see `run_in_front`."""
    end_with_parent(int(front))
    tell_through(int(pipe))
    run(words)


def exit_code(words: Sequence[str]) -> int:
    """Run the command line, say what has gone wrong, and give the exit code."""
    try:
        from meshjig.cli.commands import app  # here, so that a damaged installation ends in a sentence too

        code = app(args=with_values(words), prog_name="meshjig", standalone_mode=False)
    except BaseException as error:
        ending = _ending_of(error, words)
    else:
        if code != _INTERRUPTED:
            return code if isinstance(code, int) else 0
        ending = _ending_of(KeyboardInterrupt(), words)
    say(f"meshjig: {ending.sentence}")
    if wants_json(words):
        with suppress(MeshjigError):  # nobody can be told
            emit(ending.as_json())
    return ending.exit


def _ending_of(error: BaseException, words: Sequence[str]) -> Ending:
    """Say why a run has failed."""
    if is_usage_error(error):
        error = usage_error(error, words)
    if isinstance(error, MeshjigError):
        return Ending(error.kind, error.message, error.hint, error.stage, exit_code_of(error.kind))
    stage = stage_under_way()
    if isinstance(error, KeyboardInterrupt) or type(error).__name__ == "Abort":
        return Ending("interrupted", f"interrupted; {outcome()}", "", stage, _INTERRUPTED)
    if isinstance(error, MemoryError):
        message, kind = f"there is not enough memory; {outcome()}", "resources"
        return Ending(kind, message, "use fewer faces (--faces)", stage, exit_code_of(kind))
    logging.getLogger("meshjig").debug("unexpected failure", exc_info=error)
    reason = f"{type(error).__name__}: {error}".splitlines()[0]
    message = f"unexpected failure ({reason}); {outcome()}, and this is a bug"
    return Ending("bug", message, "-v shows where", stage, exit_code_of("bug"))
