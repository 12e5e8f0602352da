"""An interpreter of ours as a child process: it runs nothing foreign, and ends with its parent."""

from __future__ import annotations

import os
import signal
import sys

__all__ = ["end_with_parent", "interpreter_command"]

_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of prctl(2)
_KILL = getattr(signal, "SIGKILL", signal.SIGTERM)  # Windows has no SIGKILL
_EVERY = 0.5  # s between two looks, where the system does not tell

_BOOT = """
import importlib.util, sys
spec = importlib.util.spec_from_file_location("meshjig", {init!r}, submodule_search_locations=[{home!r}])
sys.modules["meshjig"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sys.modules["meshjig"])
sys.path += {paths!r}
from {module} import {function}
{function}(*sys.argv[1:])
"""


def interpreter_command(module: str, function: str, *words: str) -> list[str]:
    """Give the command line of an interpreter that calls a function of meshjig.

    It is isolated (``-I``): no current folder, no PYTHONPATH, no PYTHONSTARTUP. meshjig is the one that runs
    here, by its file. Other places where modules were found here come last, behind the standard library and
    the installed packages, so that nothing in them can stand in for those.

    Parameters
    ----------
    module, function : str, of meshjig
    *words : str, what the function is called with

    Returns
    -------
    list of str
    """
    home = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    here = {"", os.curdir, _current_folder()}
    boot = _BOOT.format(
        init=os.path.join(home, "__init__.py"),
        home=home,
        paths=[path for path in sys.path if path not in here],
        module=module,
        function=function,
    )
    flags = ["-X", "utf8"] if sys.flags.utf8_mode else []
    return [
        sys.executable,
        "-I",
        *flags,
        *(["-B"] if sys.flags.dont_write_bytecode else []),
        "-c",
        boot,
        *words,
    ]


def _current_folder() -> str:
    try:
        return os.getcwd()
    except OSError:  # it was removed
        return ""


def end_with_parent(parent: int, number: int = _KILL) -> None:
    """Have this process killed as soon as its parent is gone, whatever it does then.

    Parameters
    ----------
    parent : int, process id
    number : int, the signal that it gets then; one that it catches leaves it time to clear up

    Notes
    -----
    Linux kills it even in the middle of native code; it does so too when the thread that started it ends.
    Elsewhere a thread looks for the parent, which native code may hold up.
    """
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None).prctl(_DEATH_SIGNAL, number, 0, 0, 0)
        if os.getppid() != parent:  # it was gone before it could be watched
            os.kill(os.getpid(), number)
        return
    import threading

    threading.Thread(target=_watch, args=[parent, number], daemon=True).start()


def _watch(parent: int, number: int) -> None:
    import time

    import psutil

    while os.getppid() == parent and psutil.pid_exists(parent):
        time.sleep(_EVERY)
    os.kill(os.getpid(), number)
