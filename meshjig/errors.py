"""What can go wrong, as types; and what their sentences have in common.

::

    MeshjigError            everything below; its text is one sentence for a person
    |-- InputError          the mesh can't be read, or is no surface
    |-- OptionError         an option is out of range, or two of them contradict
    |-- ChartError          a chart can't be flattened
    |-- CutError            the surface can't be cut as asked
    |-- SolidError          a piece can't be given its thickness
    |-- OutputError         the result can't be written
    `-- ResourceError       the machine, or a limit given, has too little memory, disk or time
"""

import errno
from collections.abc import Iterable

__all__ = [
    "ChartError",
    "CutError",
    "InputError",
    "MeshjigError",
    "OptionError",
    "OutputError",
    "ResourceError",
    "SolidError",
    "did_you_mean",
    "printable",
    "write_error",
]


class MeshjigError(Exception):
    """A failure that meshjig understands.

    Parameters
    ----------
    message : str
        What is wrong, and where.
    hint : str
        What to do about it; follows the message in the printed sentence.
    ids : list of int
        Faces, charts or pieces that the message is about.
    """

    stage = "meshjig"
    kind = "failure"  # a stable word, for programs

    def __init__(self, message: str, *, hint: str = "", ids: list[int] | None = None) -> None:
        super().__init__(f"{message}: {hint}" if hint else message)
        self.message = message
        self.hint = hint
        self.ids = ids or []


class InputError(MeshjigError):
    """The mesh can't be read, or is no surface."""

    stage = "scan"
    kind = "input"


class OptionError(MeshjigError, ValueError):
    """An option is out of range, or two of them contradict.

    Parameters
    ----------
    message, hint, ids : as for `MeshjigError`
    option : str
        The field of `Options` that the message begins with, where it does; empty otherwise.
    """

    stage = "options"
    kind = "usage"

    def __init__(
        self, message: str, *, hint: str = "", ids: list[int] | None = None, option: str = ""
    ) -> None:
        super().__init__(message, hint=hint, ids=ids)
        self.option = option


class ChartError(MeshjigError):
    """A chart can't be flattened."""

    stage = "charts"
    kind = "chart"


class CutError(MeshjigError):
    """The surface can't be cut as asked."""

    stage = "cut"
    kind = "cut"


class SolidError(MeshjigError):
    """A piece can't be given its thickness."""

    stage = "solid"
    kind = "solid"


class OutputError(MeshjigError):
    """The result can't be written."""

    stage = "output"
    kind = "output"


class ResourceError(MeshjigError):
    """The machine, or a limit that was given, has too little memory, disk or time."""

    stage = "resources"
    kind = "resources"


_FULL = {errno.ENOSPC, errno.EFBIG, errno.ENOMEM, errno.EMFILE, errno.ENFILE, getattr(errno, "EDQUOT", -1)}


def write_error(what: str, error: OSError | ValueError, hint: str = "") -> OutputError | ResourceError:
    """Give the error that says that something can't be written, and why.

    Parameters
    ----------
    what : str, the beginning of the sentence, such as "the output folder a"
    error : what the system said
    hint : str

    Returns
    -------
    OutputError, or ResourceError where a disk, or a limit of the system's, is full
    """
    reason = (getattr(error, "strerror", None) or str(error)).lower()
    kind = ResourceError if getattr(error, "errno", None) in _FULL else OutputError
    return kind(f"{what} can't be written ({reason})", hint=hint)


def did_you_mean(word: str, known: Iterable[str], least: float = 0.6) -> str:
    """Give a question that names the nearest of known words, to be put behind a sentence; or nothing.

    Parameters
    ----------
    word : str
    known : iterable of str
    least : float, how like it a word has to be, 0 to 1; one that begins with it is like enough
    """
    from difflib import get_close_matches

    by_lower = {name.lower(): name for name in known}
    near = get_close_matches(word.lower(), by_lower, n=1, cutoff=least)
    near = near or [name for name in by_lower if name.startswith(word.lower())][:1] if word else []
    return f"did you mean {by_lower[near[0]]}?" if near else ""


def printable(text: str) -> str:
    r"""Escape what would move a terminal's cursor, colour it or begin a line: \x1b in place of escape."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)
