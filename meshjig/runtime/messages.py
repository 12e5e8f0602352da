"""What a run of the command line tells the process in front of it, which outlives it."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator

__all__ = ["folders_written", "lasting", "read_messages", "stage_under_way", "tell", "tell_through"]

_pipe: int | None = None
_written: list[str] = []
_stages: list[str] = []
_lasting: list[str] = []


def tell_through(pipe: int) -> None:
    """Use this file descriptor."""
    global _pipe
    _pipe = pipe
    os.set_inheritable(pipe, False)


def tell(word: str, value: str | int) -> None:
    """Tell the process in front, if there is one, about a folder or an exit code.

    The messages are ``target``, a folder that is to be replaced; ``parent``, a folder that is made for one;
    ``written``, a target that is in place, whole; ``stage``, one that begins; ``answered``, once something
    is printed on standard output; ``ended``, with the exit code;
    ``scratch``, a folder that goes with the run, and
    ``lasting``, what is there whenever a long run ends, as part of a sentence.
    """
    if word == "stage":
        _stages.append(str(value))
    if word == "written":
        _written.append(str(value))
    if word == "lasting":
        _lasting.append(str(value))
    if _pipe is not None:
        os.write(_pipe, json.dumps([word, value]).encode("ascii") + b"\n")


def folders_written() -> list[str]:
    """List the folders that this process has put in their places."""
    return list(_written)


def lasting() -> str:
    """Say what is there whenever this run ends; nothing where it has not said so."""
    return _lasting[-1] if _lasting else ""


def stage_under_way() -> str | None:
    """Name the stage that began last, if one has."""
    return _stages[-1] if _stages else None


def read_messages(pipe: int) -> Iterator[tuple[str, str | int]]:
    """Give what a run that has ended has told."""
    os.set_blocking(pipe, False)
    told = b""
    while True:
        try:
            part = os.read(pipe, 1 << 16)
        except BlockingIOError:
            break
        if not part:
            break
        told += part
    for line in told.split(b"\n")[:-1]:
        word, value = json.loads(line)
        yield word, value
