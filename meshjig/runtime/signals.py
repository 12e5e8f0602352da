"""Signals that ask a run to end, held back while something must be done in one go."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

__all__ = ["ENDING", "hold_signals"]

ENDING = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)  # Windows has no SIGHUP


@contextmanager
def hold_signals() -> Iterator[None]:
    """Hold back the signals that would end the block in the middle; they are delivered after it.

    Outside the main thread nothing is held back: Python raises nothing there, and the system's own endings
    are those of the main thread.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    held: list[int] = []

    def remember(number: int, frame: FrameType | None) -> None:
        held.append(number)

    before = {number: signal.getsignal(number) for number in ENDING}
    ours = [n for n, handler in before.items() if handler is not None and handler != signal.SIG_IGN]
    for number in ours:
        signal.signal(number, remember)
    try:
        yield
    finally:
        for number in ours:
            signal.signal(number, before[number])
        for number in dict.fromkeys(held):
            signal.raise_signal(number)
