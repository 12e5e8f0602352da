"""How many processor cores a run may use: by option, by the environment, or all that there are."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from meshjig.errors import OptionError

__all__ = ["VARIABLE", "cores", "thread_limits", "use_cores"]

VARIABLE = "MESHJIG_CORES"
_THREADS = [
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
    "NUMEXPR_NUM_THREADS",
    "RAYON_NUM_THREADS",
    "IGL_NUM_THREADS",
]
_asked: ContextVar[int | None] = ContextVar("cores", default=None)


def cores() -> int:
    """Give how many cores this run may use, at least 1.

    Raises
    ------
    OptionError
        The variable MESHJIG_CORES of the environment holds no whole number, at least 1.
    """
    asked = _asked.get()
    if asked is not None:
        return asked
    given = os.environ.get(VARIABLE, "").strip()
    if not given:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if not given.isdecimal() or int(given) < 1:
        raise OptionError(f"{VARIABLE} is {given!r}, no number of cores", hint="give at least 1, or unset it")
    return int(given)


@contextmanager
def use_cores(n: int | None) -> Iterator[None]:
    """Let the block use no more than so many cores; None leaves it as it is."""
    if n is None:
        yield
        return
    before = _asked.set(n)
    try:
        yield
    finally:
        _asked.reset(before)


def thread_limits(n: int) -> dict[str, str]:
    """Give the environment by which libraries that are not loaded yet start no more than so many threads."""
    return {VARIABLE: str(n), **dict.fromkeys(_THREADS, str(n))}
