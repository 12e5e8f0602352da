"""Stages as they run: their names for whoever watches, their seconds for the report."""

import logging
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

__all__ = ["Progress", "Stages", "peak_memory_mb"]

Progress = Callable[[str, str], None]  # (name of the stage, "start" or "end")

log = logging.getLogger("meshjig")


class Stages:
    """A stopwatch with a lap for every stage.

    Parameters
    ----------
    progress : callable, optional
        Called with a stage's name and "start" or "end".
    """

    def __init__(self, progress: Progress | None = None) -> None:
        self.progress = progress
        self.seconds: dict[str, float] = {}

    @contextmanager
    def __call__(self, name: str) -> Iterator[None]:
        """Run a stage; laps of the same name add up."""
        if self.progress:
            self.progress(name, "start")
        start = time.perf_counter()
        try:
            yield
        finally:
            lap = time.perf_counter() - start
            self.seconds[name] = self.seconds.get(name, 0.0) + lap
            log.debug("%s: %.2f s", name, lap)
            if self.progress:
                self.progress(name, "end")


def peak_memory_mb() -> float | None:
    """Give the largest memory that this process has held, MB; None where the system can't tell."""
    try:
        import resource
    except ImportError:  # Windows
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1024**2 if sys.platform == "darwin" else 1024)
