"""Work for the second core: a function of arrays, run by a child process while the caller goes on."""

from __future__ import annotations

import atexit
import contextlib
import importlib
import io
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any, cast

__all__ = ["Background"]

_SERVE = "import sys; sys.path.insert(0, sys.argv[1]); from meshjig.background import _serve; _serve()"
_PROTOCOL = pickle.HIGHEST_PROTOCOL
_GENTLE = 19  # niceness of what must not slow the caller down
_PATIENCE = 10.0  # s; a child that hears nothing for so long ends itself


class Background:
    """A function that runs beside the caller.

    The child is a fresh interpreter, not a fork and not multiprocessing: neither threads nor an unguarded
    main module of the caller matter. When it can't be started or fails, the function runs in the caller
    once the result is asked for, and raises there what it has to raise. A child that has answered waits some
    seconds for more to do, since its imports take as long as much of what it is asked.

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
        self._thread: threading.Thread | None = None
        self._child: _Child | None = None
        if alone or (os.cpu_count() or 1) < 2 or not sys.executable:
            return
        try:
            # pickled here: a thread would wait for the caller's long calls of native code again and again
            question = pickle.dumps((function.__module__, function.__qualname__, arguments), _PROTOCOL)
            self._child = _idle_child(gently) or _Child(gently)
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
        with _taking:
            if not self._answer:
                self._child.kill()
        self._thread.join()

    def _talk(self, child: _Child, question: bytes) -> None:
        try:
            answer = child.ask(question)
        except Exception:  # whatever a child that fails leaves behind; the caller does the work then
            child.end()
            return
        with _taking:
            self._answer.append(answer)
            _idle.append(child)


class _Child:
    """An interpreter that answers questions, one after the other."""

    def __init__(self, gently: bool) -> None:
        self.gently, self.owner = gently, os.getpid()
        self._process = subprocess.Popen(
            [sys.executable, "-c", _SERVE, str(Path(__file__).parent.parent), str(_GENTLE * gently)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        self._questions = cast(IO[bytes], self._process.stdin)
        self._answers = cast(IO[bytes], self._process.stdout)

    def ask(self, question: bytes) -> Any:
        """Give the answer; OSError or EOFError when the child has failed."""
        self._questions.write(question)
        self._questions.flush()
        return pickle.load(self._answers)

    def alive(self) -> bool:
        return self._process.poll() is None

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()

    def end(self) -> None:
        self.kill()
        for pipe in (self._questions, self._answers):
            with contextlib.suppress(OSError):
                pipe.close()


_idle: list[_Child] = []
_taking = threading.Lock()


def _idle_child(gently: bool) -> _Child | None:
    """Take a child that waits, if there is one of this process's."""
    with _taking:
        own = [child for child in _idle if child.owner == os.getpid()]
        alive = [child for child in own if child.alive()]
        for child in own:
            if child not in alive:
                child.end()
        fitting = [child for child in alive if child.gently == gently]
        _idle[:] = [child for child in alive if child not in fitting[-1:]]
        return fitting[-1] if fitting else None


@atexit.register
def _end_all() -> None:
    for child in _idle:
        if child.owner == os.getpid():
            child.kill()


def _serve() -> None:
    """Answer questions from standard input on standard output, until there are no more."""
    if niceness := int(sys.argv[2]):
        with contextlib.suppress(AttributeError, OSError):
            os.nice(niceness)
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever native code prints
    questions = cast(io.BufferedReader, sys.stdin.buffer)
    while True:
        patience = threading.Timer(_PATIENCE, os._exit, [0])
        patience.daemon = True
        patience.start()
        if not questions.peek(1):
            return
        patience.cancel()
        module, name, arguments = pickle.load(questions)
        answer = getattr(importlib.import_module(module), name)(*arguments)
        answers.write(pickle.dumps(answer, _PROTOCOL))
        answers.flush()
        del arguments, answer
