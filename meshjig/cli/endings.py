"""How a run ends: the exit codes, and the object that --json prints of a failure.

It imports next to nothing, since the process in front of a run tells of endings too.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import NamedTuple

__all__ = [
    "BROKEN_PROMISE",
    "BUG",
    "CUT_OFF",
    "EPILOG",
    "FAILED",
    "NO_RESOURCES",
    "Ending",
    "broken_promises",
    "exit_code_of",
    "wants_json",
]

FAILED, USAGE, BROKEN_PROMISE, BAD_INPUT, NO_RESOURCES, BUG = 1, 2, 3, 4, 5, 70
_SAID = {
    "exempt": "more than a tenth of the puzzle is exempt, because the model crosses itself there",
    "thin_walls": "walls thinner than --min-wall where the model is not (thin_walls)",
}
CUT_OFF = 128  # and the number of the signal

EPILOG = """Exit codes: 0 good; 2 wrong usage; 3 a promise is broken, though the files are there; 4 bad input;
5 too little memory, disk or time; 1 any other failure; 70 a bug of meshjig; 128 + N ended by signal N.
With --json, failures too print one object: {"ok": false, "error": {"kind", "message", "hint", "stage"},
"exit": N}."""

_CODES = {
    "usage": USAGE,
    "promise": BROKEN_PROMISE,
    "input": BAD_INPUT,
    "resources": NO_RESOURCES,
    "bug": BUG,
}


class Ending(NamedTuple):
    """Why a run has failed."""

    kind: (
        str  # usage, input, chart, cut, solid, output, resources, promise, bug, interrupted, killed, failure
    )
    message: str  # what is wrong, and where
    hint: str  # what to do about it, or nothing
    stage: str | None  # in which it happened, where that is known
    exit: int

    @property
    def sentence(self) -> str:
        """What a person is told."""
        return f"{self.message}: {self.hint}" if self.hint else self.message

    def as_dict(self) -> dict[str, object]:
        """Give what a program is told."""
        error = {"kind": self.kind, "message": self.message, "hint": self.hint, "stage": self.stage}
        return {"ok": False, "error": error, "exit": self.exit}

    def as_json(self) -> str:
        """Give what a program is told, as one line."""
        return json.dumps(self.as_dict())


def exit_code_of(kind: str) -> int:
    """Give the exit code that goes with a kind of failure, other than an ending by a signal."""
    return _CODES.get(kind, FAILED)


def broken_promises(failures: dict[str, list[str]]) -> list[str]:
    """Name every broken promise and the pieces that break it, a sentence each."""
    said = []
    for promise, names in failures.items():
        shown = ", ".join(names[:8]) + (f" and {len(names) - 8} more" if len(names) > 8 else "")
        said.append(f"broken promise: {_SAID.get(promise, promise)}" + (f" ({shown})" if names else ""))
    return said


def wants_json(words: Sequence[str]) -> bool:
    """Tell whether --json is among the words of a command line, before they are understood."""
    words = list(words)
    return "--json" in words[: words.index("--") if "--" in words else None]
