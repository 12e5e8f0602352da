"""Work for the second core: a function of arrays, run by a child process while the caller goes on."""

from __future__ import annotations

import pickle
import sys
import threading
from collections.abc import Callable
from typing import Any

from meshjig.runtime.child import Child, idle_child, keep_idle, packed
from meshjig.runtime.cores import cores

__all__ = ["Background"]


class Background:
    """A function that runs beside the caller.

    When no child can be started, or it fails, the function runs in the caller once the result is asked for,
    and raises there what it has to raise. A child that has answered waits some seconds for more to do, since
    its imports take as long as much of what it is asked.

    Parameters
    ----------
    function : callable, at the top level of a module of meshjig
    *arguments : whatever pickle takes
    alone : bool, don't start a child; run when the result is asked for
    gently : bool, leave the cores to others as long as these want them
    """

    def __init__(
        self, function: Callable[..., Any], *arguments: Any, alone: bool = False, gently: bool = False
    ) -> None:
        self._function, self._arguments = function, arguments
        self._answer: list[Any] = []
        self._cancelled = False
        self._thread: threading.Thread | None = None
        self._child: Child | None = None
        if alone or cores() < 2 or not sys.executable:
            return
        try:
            # pickled here: a thread would wait for the caller's long calls of native code again and again
            question = packed(function.__module__, function.__qualname__, arguments)
            self._child = idle_child(gently) or Child(gently)
        except (OSError, pickle.PickleError, TypeError, AttributeError):
            return
        self._thread = threading.Thread(target=self._talk, args=[self._child, question], daemon=True)
        self._thread.start()

    def result(self) -> Any:
        """Wait for what the function returns."""
        if self._thread is not None:
            self._thread.join()
        if not self._answer:
            self._answer.append(self._function(*self._arguments))
        return self._answer[0]

    def cancel(self) -> None:
        """End the child; nobody will ask for the result."""
        if self._child is None or self._thread is None:
            return
        with _cancelling:
            self._cancelled = True
            if not self._answer:
                self._child.kill()
        self._thread.join()

    def _talk(self, child: Child, question: bytes) -> None:
        try:
            answer = child.ask(question)
        except Exception:  # whatever a child that fails leaves behind; the caller does the work then
            child.end()
            return
        with _cancelling:
            self._answer.append(answer)
            if not self._cancelled:
                keep_idle(child)


_cancelling = threading.Lock()
