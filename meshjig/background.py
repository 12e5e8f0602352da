"""Work for the second core: a function of arrays, run by a child process while the caller goes on."""

from __future__ import annotations

import importlib
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

__all__ = ["Background"]

_SERVE = "import sys; sys.path.insert(0, sys.argv[1]); from meshjig.background import _serve; _serve()"


class Background:
    """A function that runs beside the caller.

    The child is a fresh interpreter, not a fork and not multiprocessing: neither threads nor an unguarded
    main module of the caller matter. When it can't be started or fails, the function runs in the caller
    once the result is asked for, and raises there what it has to raise.

    Parameters
    ----------
    function : callable, at the top level of a module of meshjig
    *arguments : whatever pickle takes
    alone : bool, don't start a child; run when the result is asked for
    """

    def __init__(self, function: Callable[..., Any], *arguments: Any, alone: bool = False) -> None:
        self._function, self._arguments = function, arguments
        self._answer: bytes | None = None
        self._thread: threading.Thread | None = None
        self._child: subprocess.Popen[bytes] | None = None
        if alone or (os.cpu_count() or 1) < 2 or not sys.executable:
            return
        try:
            self._child = subprocess.Popen(
                [sys.executable, "-c", _SERVE, str(Path(__file__).parent.parent)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
            )
        except OSError:
            return
        self._thread = threading.Thread(target=self._talk, args=[self._child], daemon=True)
        self._thread.start()

    def result(self) -> Any:
        """Wait for what the function returns."""
        if self._thread is not None:
            self._thread.join()
        if self._answer is not None:
            return pickle.loads(self._answer)
        return self._function(*self._arguments)

    def cancel(self) -> None:
        """End the child; nobody will ask for the result."""
        if self._child is not None:
            self._child.kill()
            self._child.wait()

    def _talk(self, child: subprocess.Popen[bytes]) -> None:
        question = pickle.dumps((self._function.__module__, self._function.__qualname__, self._arguments))
        answer, _ = child.communicate(question)
        if child.returncode == 0 and answer:
            self._answer = answer


def _serve() -> None:
    """Answer one question from standard input on standard output."""
    module, name, arguments = pickle.load(sys.stdin.buffer)
    answer = getattr(importlib.import_module(module), name)(*arguments)
    pickle.dump(answer, sys.stdout.buffer)
