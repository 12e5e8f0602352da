"""Readers of what others wrote: run by a child process, with limits of memory and time."""

from __future__ import annotations

import importlib
import os
import pickle
import sys
import threading
import time
from typing import Any, NamedTuple

from meshjig.errors import MeshjigError
from meshjig.runtime.child import Child, allow, idle_child, keep_idle, packed

__all__ = ["Bounded", "Limits", "OutOfBounds", "ReadAhead", "allow_file"]

_EVERY = 0.01  # s between two looks at what the child uses


_MEMORY, _SECONDS = 800_000_000, 5.0  # bytes and s that reading may take, however small the file is
_MEMORY_A_BYTE, _SECONDS_A_BYTE = 30.0, 4e-7  # and once more for every byte of the file


class Limits(NamedTuple):
    """What a question may use."""

    memory: float = _MEMORY  # bytes, resident
    seconds: float = _SECONDS  # of the processor's time, and, once more, of waiting without it


def allow_file(path: str | os.PathLike[str], share: float = 1.0) -> None:
    """In a child that reads a file: raise its limits by what an honest file of this size may need.

    Parameters
    ----------
    path : path
    share : float, of that; more for a file that is packed
    """
    size = share * os.stat(path).st_size
    allow(size * _MEMORY_A_BYTE, size * _SECONDS_A_BYTE)


class OutOfBounds(Exception):
    """A reader went beyond its limits, or crashed; the text says which, to follow the name of a file."""

    def __init__(self, text: str, crashed: bool = False) -> None:
        super().__init__(text)
        self.crashed = crashed


class Bounded:
    """A function that runs in a child process within limits, beside the caller.

    Memory is watched, not limited by the system: native code that is refused memory hangs or crashes. Time is
    the processor's, so that a busy machine does not end what is sound; a reader that only waits is ended too.

    Parameters
    ----------
    module, function : str, where the function is; the caller need not import it
    *arguments : whatever pickle takes
    limits : Limits, optional
    package : str, optional
        Where the types of the answer are; see `Child.ask`.
    """

    def __init__(
        self, module: str, function: str, *arguments: Any, limits: Limits | None = None, package: str = ""
    ) -> None:
        self._question, self._limits = packed(module, function, arguments), limits or Limits()
        self._package = package
        self._named, self._arguments = (module, function), arguments
        self._outcome: list[Any] = []
        self._beyond = ""
        self._threads: list[threading.Thread] = []
        if sys.executable:  # else meshjig is part of another program
            idle = idle_child()
            self._reused, self._child = idle is not None, idle or Child()
            for task in (self._talk, self._watch):
                thread = threading.Thread(target=task, daemon=True)
                self._threads.append(thread)
                thread.start()

    def result(self) -> Any:
        """Wait for what the function returns.

        Raises
        ------
        MeshjigError
            What the function raised.
        OutOfBounds
            It used more than it may, or crashed.
        """
        if not self._threads:
            module, function = self._named
            return getattr(importlib.import_module(module), function)(*self._arguments)
        try:
            self._threads[0].join()
        except BaseException:  # an interrupt
            self._child.end()
            raise
        answer = self._outcome[0]
        if isinstance(answer, MeshjigError):
            raise answer
        if isinstance(answer, _Failed):
            raise OutOfBounds(self._beyond or "makes its reader crash", not self._beyond)
        return answer

    def _talk(self) -> None:
        try:
            self._outcome.append(self._ask())
        except MeshjigError as error:
            self._outcome.append(error)
        except _FAILURES:
            self._child.end()
            self._outcome.append(_Failed())
            return
        keep_idle(self._child)

    def _ask(self) -> Any:
        try:
            return self._child.ask(self._question, self._package)
        except _FAILURES:
            if not self._reused or self._beyond:
                raise
        self._child.end()  # it ended with what it was started for, such as a thread of the caller's
        self._child = Child()
        return self._child.ask(self._question, self._package)

    def _watch(self) -> None:
        """End the child once it goes beyond its limits."""
        import psutil

        while not self._outcome and not self._beyond:
            try:
                self._watch_child(psutil.Process(self._child.process.pid))
            except psutil.Error:  # it has just ended
                time.sleep(_EVERY)

    def _watch_child(self, process: Any) -> None:
        import psutil

        held, started = process.memory_info().rss, sum(process.cpu_times()[:2])
        waited, before, then = 0.0, started, time.monotonic()
        while not self._outcome and process.pid == self._child.process.pid:
            time.sleep(_EVERY)
            with process.oneshot():
                memory, used = process.memory_info().rss - held, sum(process.cpu_times()[:2])
                waits = process.status() == psutil.STATUS_SLEEPING and used == before
            now = time.monotonic()
            waited, before, then = waited + waits * (now - then), used, now
            seconds = max(used - started, waited)
            if memory > self._limits.memory + self._child.memory:
                self._beyond = f"needs more than {memory / 1e9:.1f} GB of memory to be read"
            elif seconds > self._limits.seconds + self._child.seconds:
                self._beyond = f"takes more than {seconds:.0f} s to be read"
            if self._beyond:
                self._child.kill()
                return


_FAILURES = OSError, EOFError, pickle.UnpicklingError, ValueError


class _Failed:
    """Stands for the answer of a child that has failed."""


_PACKAGE = "meshjig.scan"
_READER = "meshjig.scan.files.reading", "read_file"  # by name: to import it takes as long as to read


class ReadAhead:
    """A mesh file in place of its path: it is being read while what makes a puzzle of it is imported.

    Parameters
    ----------
    path : path
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        self._answer = Bounded(*_READER, self.path, package=_PACKAGE)
        importlib.import_module(_PACKAGE)  # before all that imports modules of it, see `Child.ask`

    def result(self) -> Any:
        """Wait for what the file holds.

        Returns
        -------
        meshjig.scan.files.reading.FileMesh

        Raises
        ------
        InputError
            What is wrong with the file.
        OutOfBounds
            Its reader crashed, or went beyond the limits of memory and time.
        """
        try:
            return self._answer.result()
        except OutOfBounds as error:
            if not error.crashed:
                raise
        return Bounded(*_READER, self.path, False).result()  # without the reader that crashes most
