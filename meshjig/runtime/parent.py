"""End with the parent process, however it ends."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time

__all__ = ["end_with_parent"]

_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of prctl(2)
_EVERY = 0.5  # s between two looks, where the system does not tell


def end_with_parent(parent: int) -> None:
    """Have this process killed as soon as its parent is gone, whatever it does then.

    Parameters
    ----------
    parent : int, process id

    Notes
    -----
    Linux kills it even in the middle of native code; it does so too when the thread that started it ends.
    Elsewhere a thread looks for the parent, which native code may hold up.
    """
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None).prctl(_DEATH_SIGNAL, signal.SIGKILL, 0, 0, 0)
        if os.getppid() != parent:  # it was gone before it could be watched
            os._exit(1)
        return
    threading.Thread(target=_watch, args=[parent], daemon=True).start()


def _watch(parent: int) -> None:
    import psutil

    while os.getppid() == parent and psutil.pid_exists(parent):
        time.sleep(_EVERY)
    os._exit(1)
