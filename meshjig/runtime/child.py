"""A child process that answers questions: functions of meshjig, called with what pickle takes."""

from __future__ import annotations

import atexit
import contextlib
import importlib
import io
import os
import pickle
import signal
import subprocess
import sys
import threading
from typing import IO, Any, cast

from meshjig.errors import MeshjigError
from meshjig.runtime.interpreter import end_with_parent, interpreter_command

__all__ = ["Child", "allow", "idle_child", "keep_idle", "packed"]

_PROTOCOL = pickle.HIGHEST_PROTOCOL
_GENTLE = 19  # niceness of what must not slow the caller down
_PATIENCE = 10.0  # s; a child that hears nothing for so long ends itself


def packed(module: str, function: str, arguments: tuple[Any, ...]) -> bytes:
    """Give the question that calls a function at the top level of a module."""
    return pickle.dumps((module, function, arguments), _PROTOCOL)


class Child:
    """An interpreter that answers questions, one after the other.

    It is a fresh interpreter, not a fork and not multiprocessing: neither threads nor an unguarded main
    module of the caller matter. It ends with its parent.
    """

    def __init__(self, gently: bool = False) -> None:
        self.gently, self.owner = gently, os.getpid()
        self.memory, self.seconds = 0.0, 0.0  # what the question under way may use beyond its limits
        words = [str(os.getpid()), str(_GENTLE * gently)]
        self.process = subprocess.Popen(
            interpreter_command(__name__, "serve", *words),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        self._questions = cast(IO[bytes], self.process.stdin)
        self._answers = cast(IO[bytes], self.process.stdout)
        _running.add(self)

    def ask(self, question: bytes, package: str = "") -> Any:
        """Give the answer, whose types are in a package.

        A thread that asks imports it as a whole before it touches a module there: two threads that import a
        package and one of its modules at the same time would each wait for the other.

        Raises
        ------
        MeshjigError
            What the function raised, where it is one of these.
        OSError, EOFError, pickle.UnpicklingError
            The child has failed.
        """
        self.memory, self.seconds = 0.0, 0.0
        self._questions.write(question)
        self._questions.flush()
        if package:
            importlib.import_module(package)
        while True:
            kind, answer = pickle.load(self._answers)
            if kind == "answer":
                return answer
            if kind == "error":
                raise answer
            self.memory, self.seconds = self.memory + answer[0], self.seconds + answer[1]

    def alive(self) -> bool:
        """Tell whether the child still runs."""
        return self.process.poll() is None

    def kill(self) -> None:
        """End the child; whoever waits for an answer hears that it has failed."""
        self.process.kill()
        self.process.wait()

    def end(self) -> None:
        """End the child, and close what led to it."""
        _running.discard(self)
        self.kill()
        for pipe in (self._questions, self._answers):
            with contextlib.suppress(OSError):
                pipe.close()


_running: set[Child] = set()
_idle: list[Child] = []
_taking = threading.Lock()


def idle_child(gently: bool = False) -> Child | None:
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


def keep_idle(child: Child) -> None:
    """Keep a child that has answered for the next question; its imports are worth it."""
    with _taking:
        _idle.append(child)


@atexit.register
def _end_all() -> None:
    for child in list(_running):  # those still at work, too: nobody will hear their answers
        if child.owner == os.getpid():
            child.end()


_frames: IO[bytes] | None = None  # of a child, to whoever asks it


def allow(memory: float, seconds: float) -> None:
    """Raise the limits of the question under way, before something is read that is known to be no trick.

    Parameters
    ----------
    memory : float, bytes
    seconds : float
    """
    if _frames is not None:
        _send("more", (memory, seconds))


def serve(parent: str, niceness: str) -> None:
    """Answer questions from standard input on standard output, until there are no more."""
    global _frames
    end_with_parent(int(parent))
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the parent too, which decides
    if int(niceness):
        with contextlib.suppress(AttributeError, OSError):
            os.nice(int(niceness))
    _frames = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever native code prints
    questions = cast(io.BufferedReader, sys.stdin.buffer)
    while True:
        patience = threading.Timer(_PATIENCE, os._exit, [0])
        patience.daemon = True
        patience.start()
        if not questions.peek(1):
            os._exit(0)
        patience.cancel()
        module, name, arguments = pickle.load(questions)
        try:
            answer = getattr(importlib.import_module(module), name)(*arguments)
        except MeshjigError as error:
            _send("error", error)
        else:
            _send("answer", answer)
            del answer
        del arguments


def _send(kind: str, value: Any) -> None:
    frames = cast(IO[bytes], _frames)
    pickle.dump((kind, value), frames, _PROTOCOL)
    frames.flush()
