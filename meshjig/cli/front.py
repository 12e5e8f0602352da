"""The process in front of a run: it ends the run when asked to, in whatever native code it is, and clears up.

It imports next to nothing, so that it listens from its first moments on. The run itself is its child,
which is killed without being asked: what it had begun is known by what it told, and by the journal
beside its output folder.
"""

from __future__ import annotations

import os
import signal
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import FrameType
    from typing import NoReturn

    from meshjig.cli.endings import Ending

__all__ = ["run_for", "run_in_front"]

_LEAST_SPACE = 1e9  # bytes of address space; with 0.4e9 libraries wait for threads that can't start
_CRASHES = {"SIGSEGV": "a segmentation fault", "SIGABRT": "an abort", "SIGBUS": "a bus error"}
_SHOW_CURSOR = b"\r\x1b[K\x1b[?25h"  # a progress line may have hidden it

_asked_by = 0  # the signal that asked for the end
_run = 0  # the process id of the run
_owner = 0  # the process that the run ends with, where there is one
_scratch = ""  # a folder that goes with the owner


def run_for(owner: str, scratch: str, *words: str) -> NoReturn:
    """Run the command line for a process that may itself be killed at any moment.

    Called in a process that leads a group of its own. Once the owner is gone, the run is ended as by a
    signal, then whatever else is left of the group, and the scratch folder with it.
    """
    global _owner, _scratch
    from meshjig.runtime.interpreter import end_with_parent

    _owner, _scratch, sys.argv[1:] = int(owner), scratch, words
    signal.signal(signal.SIGHUP, _end_the_run)
    end_with_parent(_owner, signal.SIGHUP)
    run_in_front()


def run_in_front() -> NoReturn:
    """Run the command line in a child process, and end with its exit code."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:  # as nohup wants it
            signal.signal(number, _end_the_run)
    _open_standard_streams()
    _refuse_little_memory()
    reading, status = _wait_for_run()
    _leave(reading, status)


def _end_the_run(number: int, frame: FrameType | None) -> None:
    global _asked_by
    _asked_by = _asked_by or number
    if _run:
        try:
            os.kill(_run, signal.SIGKILL)
        except ProcessLookupError:  # it has just ended
            return


def _open_standard_streams() -> None:
    """Put nothing in the place of standard streams that are closed, lest a file of ours takes it."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
            os.set_inheritable(number, True)


def _wait_for_run() -> tuple[int, int]:
    """Give the pipe with the run's messages, and its status, once it has ended."""
    global _run
    from meshjig.runtime.interpreter import interpreter_command

    reading, writing = os.pipe()
    os.set_inheritable(writing, True)
    words = [str(os.getpid()), str(writing), *sys.argv[1:]]
    command = interpreter_command("meshjig.cli.run", "run_behind_front", *words)
    _run = os.posix_spawn(command[0], command, os.environ, setsigmask=[signal.SIGINT])
    os.close(writing)
    if _asked_by:
        os.kill(_run, signal.SIGKILL)
    _, status = os.waitpid(_run, 0)
    _run = 0
    return reading, status


def _leave(reading: int, status: int) -> NoReturn:
    from meshjig.runtime.messages import read_messages

    told = list(read_messages(reading))
    targets = dict.fromkeys(str(value) for word, value in told if word == "target")
    written = {str(value) for word, value in told if word == "written"}
    ended = [int(value) for word, value in told if word == "ended"]
    number = _asked_by or (os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0)
    if ended and not _asked_by:
        _exit(ended[-1])
    if os.isatty(2):
        os.write(2, _SHOW_CURSOR)
    for target in targets:
        written |= {target} if _clear_up(target) else set()
    for folder in [str(value) for word, value in told if word == "scratch"]:
        _remove(folder)
    for parent in [str(value) for word, value in told if word == "parent"][::-1]:
        try:
            os.rmdir(parent)
        except OSError:
            continue
    _tell_ending(number, sorted(written), dict(told))


def _tell_ending(number: int, written: list[str], told: dict[str, str | int]) -> NoReturn:
    """Say by what signal the run has ended, and end likewise."""
    from meshjig.cli.endings import BUG, CUT_OFF, NO_RESOURCES, Ending

    name = signal.Signals(number).name if number else "an exit of its own"  # as some libraries have it
    done = f"{', '.join(written)} is whole" if written else "nothing was written"
    done = str(told.get("lasting", done))
    stage = str(told["stage"]) if "stage" in told else None
    short = told.get("memory") or _short_of_address_space(name)
    if _asked_by or name in ("SIGTERM", "SIGHUP", "SIGINT"):
        ending = Ending("interrupted", f"interrupted; {done}", "", stage, CUT_OFF + number)
    elif short:
        hint = "use a mesh of fewer faces, or allow more memory"
        ending = Ending("resources", f"{short}; {done}", hint, stage, NO_RESOURCES)
    elif name == "SIGKILL":
        message = f"the run was killed, perhaps for want of memory; {done}"
        hint = "" if "lasting" in told else "use fewer faces (--faces)"
        ending = Ending("killed", message, hint, stage, CUT_OFF + number)
    else:
        message = f"native code ended by {_CRASHES.get(name, name)}; {done}"
        ending = Ending("bug", message, "this is a bug, -v shows where", stage, BUG)
    _end(ending, "answered" in told)


def _end(ending: Ending, answered: bool = False) -> NoReturn:
    """Tell of an ending, on standard output too unless something is there already."""
    from meshjig.cli.endings import wants_json

    _write(2, f"meshjig: {ending.sentence}\n")
    if wants_json(sys.argv[1:]) and not answered:
        _write(1, ending.as_json() + "\n")
    _exit(ending.exit)


def _exit(code: int) -> NoReturn:
    """End this process; where its owner is gone, with all that it leads."""
    if _owner and (_asked_by == signal.SIGHUP or os.getppid() != _owner):
        _remove(_scratch)
        os.killpg(0, signal.SIGKILL)
    os._exit(code)


def _remove(folder: str) -> None:
    from shutil import rmtree

    rmtree(folder, ignore_errors=True)


def _refuse_little_memory() -> None:
    """End at once under a limit of address space under which libraries hang or crash as they start."""
    import resource

    most = resource.getrlimit(resource.RLIMIT_AS)[0]
    needs_it = sys.argv[1:2] in (["make"], ["info"], ["check"])
    if needs_it and most != resource.RLIM_INFINITY and most < _LEAST_SPACE:
        from meshjig.cli.endings import NO_RESOURCES, Ending

        allowed = f"only {most / 1e9:.2g} GB of address space are allowed (ulimit -v)"
        message = f"{allowed}, and {_LEAST_SPACE / 1e9:g} GB is the least; nothing was written"
        _end(Ending("resources", message, "allow more", None, NO_RESOURCES))


def _short_of_address_space(name: str) -> str:
    """Say what limit of the system's native code may have crashed at; nothing where there is none."""
    import resource

    most = resource.getrlimit(resource.RLIMIT_AS)[0]
    if most == resource.RLIM_INFINITY or name not in _CRASHES:
        return ""
    return f"native code ended by {_CRASHES[name]} under a limit of {most / 1e9:.2g} GB of memory (ulimit -v)"


def _clear_up(target: str) -> bool:
    """Tell whether the run had put its folder in the target's place."""
    from pathlib import Path

    from meshjig.errors import MeshjigError
    from meshjig.output.folder.claim import settle

    try:
        return settle(Path(target))
    except (MeshjigError, OSError):  # another run has taken over, or the disk is gone
        return False


def _write(stream: int, text: str) -> None:
    try:
        os.write(stream, text.encode("utf-8", "backslashreplace"))
    except OSError:
        return
