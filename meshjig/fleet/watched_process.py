"""A command in a process group of its own, within limits of time and of memory for all of the group."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["Cancelled", "Ended", "GroupLimits", "run_watched"]

_EVERY = 0.05  # s; of so many of these:
_LOOKS, _FINDS, _ASKS = 4, 8, 10  # one look at memory, one at who belongs to it, one whether anybody waits
_PATIENCE = 1.5  # s that the command has to clear up once it is asked to end
_SLACK = 1.1  # memory beyond which it is ended here: the command looks after its limit itself, and says more


class Cancelled(Exception):
    """Nobody waits for the result any more; the command was ended."""


class GroupLimits(NamedTuple):
    """What a command and all that it starts may use."""

    seconds: float
    memory: float  # GB, resident, all processes together


class Ended(NamedTuple):
    """How a command ended."""

    code: int  # exit code, negative: the signal
    beyond: str  # what it was ended for: "time", "memory", or nothing
    seconds: float
    peak_mb: float
    said: str  # the last lines on standard error
    answer: str  # what it printed on standard output


def run_watched(
    words: Sequence[str],
    limits: GroupLimits,
    folder: Path,
    environment: dict[str, str],
    cancelled: Callable[[], bool],
) -> Ended:
    """Run a command to its end, and let nothing of it remain.

    Parameters
    ----------
    words : sequence of str
    limits : GroupLimits
        Beyond them it gets SIGTERM, then its group SIGKILL.
    folder : Path
        Its current folder, and where what it prints is kept.
    environment : dict
    cancelled : callable
        Asked twice a second whether anybody still waits.

    Raises
    ------
    Cancelled
        Nobody does.
    OSError
        It can't be started.
    """
    out, said = folder / "answer", folder / "said"
    begun = time.monotonic()
    with out.open("wb") as to_out, said.open("wb") as to_said:
        process = subprocess.Popen(
            words,
            stdin=subprocess.DEVNULL,
            stdout=to_out,
            stderr=to_said,
            cwd=folder,
            env=environment,
            start_new_session=True,
        )
    family = _Family(process.pid)
    try:
        beyond = _wait(process.pid, family, limits, cancelled)
        if beyond:
            with suppress(ProcessLookupError):
                os.kill(process.pid, signal.SIGTERM)
            _until_ended(process.pid, _PATIENCE)
    finally:
        family.end()
        process.wait()
    if beyond == "cancelled":
        raise Cancelled
    return Ended(
        process.returncode, beyond, time.monotonic() - begun, family.peak / 1e6, _tail(said), _tail(out)
    )


class _Family:
    """A process, what it has started, and what these have: as long as any of them is there."""

    def __init__(self, leader: int) -> None:
        self.leader, self.peak, self.held = leader, 0, 0
        self._members: dict[int, Any] = {}  # process id -> psutil.Process

    def find(self) -> None:
        """See who belongs to it; it takes a few milliseconds of the processor's time."""
        import psutil

        self._members = {pid: process for pid, process in self._members.items() if process.is_running()}
        with suppress(psutil.Error):
            leader = psutil.Process(self.leader)
            found = [leader, *leader.children(recursive=True)]
            self._members |= {process.pid: process for process in found}

    def look(self) -> None:
        """Add up how much memory those hold that were found, bytes."""
        import psutil

        self.held = 0
        for process in self._members.values():
            with suppress(psutil.Error):
                self.held += process.memory_info().rss
        self.peak = max(self.peak, self.held)

    def end(self) -> None:
        """Kill the group, and whoever has left it; the leader is to be waited for after that."""
        import psutil

        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self.leader, signal.SIGKILL)
        for process in self._left():
            with suppress(psutil.Error):
                process.kill()
        end = time.monotonic() + _PATIENCE
        while self._left() and time.monotonic() < end:
            time.sleep(_EVERY)

    def _left(self) -> list[Any]:
        """List those seen, other than the leader, that still run."""
        import psutil

        left = []
        for process in self._members.values():
            with suppress(psutil.Error):  # whose number went to another does not count as running
                alive = process.is_running() and process.status() != psutil.STATUS_ZOMBIE
                if alive and process.pid != self.leader:
                    left.append(process)
        return left


def _wait(leader: int, family: _Family, limits: GroupLimits, cancelled: Callable[[], bool]) -> str:
    """Wait until a command ends; or say why it is to be ended."""
    end = time.monotonic() + limits.seconds
    turns, too_large = 0, 0
    while not _has_ended(leader):
        if turns % _FINDS == 0:
            family.find()
        if turns % _LOOKS == 0:
            family.look()
            too_large = too_large + 1 if family.held > limits.memory * 1e9 * _SLACK else 0
            if too_large > 1:
                return "memory"
        if turns % _ASKS == _ASKS - 1 and cancelled():
            return "cancelled"
        if time.monotonic() > end:
            return "time"
        turns += 1
        time.sleep(_EVERY)
    return ""


def _until_ended(leader: int, seconds: float) -> None:
    end = time.monotonic() + seconds
    while not _has_ended(leader) and time.monotonic() < end:
        time.sleep(_EVERY)


def _has_ended(leader: int) -> bool:
    """Tell whether a child has ended, and leave it to be waited for: so its number stays its own."""
    return os.waitid(os.P_PID, leader, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None


_MOST = 1 << 24  # bytes of what a command prints that are read


def _tail(path: Path) -> str:
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - _MOST))
        return file.read().decode("utf-8", "replace").strip()
