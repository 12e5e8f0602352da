"""A limit of memory that is watched while a run goes on."""

from __future__ import annotations

import os
import signal
import threading
import time

from meshjig.runtime.messages import tell

__all__ = ["family_memory", "watch_memory"]

_EVERY = 0.1  # s between two looks


def family_memory() -> int:
    """Give the resident memory of this process and of its children, bytes; what they share counts twice."""
    import psutil

    me = psutil.Process()
    total = int(me.memory_info().rss)
    for child in me.children(recursive=True):
        try:
            total += int(child.memory_info().rss)
        except psutil.Error:  # it has just ended
            continue
    return total


def watch_memory(most: float) -> None:
    """End this process, by a kill, once it and its children hold more memory than they may.

    The process in front, which hears of it first, says so and clears up. Native code that does not let go of
    the interpreter is ended when it does.

    Parameters
    ----------
    most : float, GB
    """

    def watch() -> None:
        while (held := family_memory()) <= most * 1e9:
            time.sleep(_EVERY)
        tell("memory", f"{held / 1e9:.2g} GB of memory are in use, more than the {most:g} GB of --memory")
        os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))

    threading.Thread(target=watch, daemon=True).start()
