"""One scan of a batch, made by a process of its own: whatever that ends by, a record comes back."""

from __future__ import annotations

import functools
import hashlib
import json
import os
import re
import signal
import socket
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path, PurePosixPath
from typing import Any

from meshjig.errors import MeshjigError
from meshjig.fleet.finished import facts_of, is_finished, whole_report
from meshjig.fleet.named_files import with_named_files
from meshjig.fleet.places import below, fetch, is_url, pull_folder, push_file, push_folder
from meshjig.fleet.record import BROKEN, FAILED, MADE, TIME, Marks, Record, failed_by_machine
from meshjig.fleet.scratch import scratch_folder, sweep
from meshjig.fleet.task import Task, options_digest, written_options
from meshjig.fleet.thumbnail import thumbnail, thumbnail_name
from meshjig.fleet.toml_text import toml_text
from meshjig.fleet.watched_process import Cancelled, Ended, GroupLimits, run_watched
from meshjig.options import Options
from meshjig.output.report import Report
from meshjig.runtime.cores import thread_limits
from meshjig.runtime.interpreter import interpreter_command
from meshjig.runtime.version import meshjig_version

__all__ = ["make_scan", "never"]

_BUSY = "another run of meshjig is writing"  # of a worker that was just lost, and is being ended
_PATIENCE = 20  # s for that
_CRASH = re.compile(r"native code ended by .*?(segmentation fault|an abort|a bus error|SIG[A-Z]+)")
_BY_WORD = {"segmentation fault": "SIGSEGV", "an abort": "SIGABRT", "a bus error": "SIGBUS"}


def never() -> bool:
    """Say that somebody still waits."""
    return False


def make_scan(task: Task, cancelled: Callable[[], bool] = never) -> Record:
    """Make one scan's puzzle, unless it is there already.

    Parameters
    ----------
    task : Task
    cancelled : callable
        Tells whether nobody waits for the record any more.

    Returns
    -------
    Record, of a failure too

    Raises
    ------
    Cancelled
        Nobody waits; what was begun is ended and cleared away.
    """
    begun = time.monotonic()
    record = Record(task.name, task.source, FAILED, attempts=task.attempt, host=socket.gethostname())
    if task.refused:
        return replace(record, kind="usage", message=task.refused, stage="options", exit=2)
    if meshjig_version() != task.terms.version:
        says = f"the worker on {record.host} has meshjig {meshjig_version()}, the batch {task.terms.version}"
        return replace(record, kind="resources", message=says, hint="install the same everywhere")
    _swept()
    try:
        with scratch_folder() as folder:
            record = _make_in(folder, task, record, cancelled)
    except Cancelled:
        raise
    except Exception as error:  # the network, the disk, or whatever a file system of others raises
        message = f"{task.source} could not be worked on ({type(error).__name__}: {error})".splitlines()[0]
        if isinstance(error, MeshjigError):
            message = str(error)
        record = replace(record, kind="resources", message=message, stage="files")
    return record if record.kept else replace(record, seconds=round(time.monotonic() - begun, 3))


@functools.cache
def _swept() -> None:
    sweep()


def _make_in(folder: Path, task: Task, record: Record, cancelled: Callable[[], bool]) -> Record:
    terms, options = task.terms, Options.of(**task.given)
    mesh = Path(task.source)
    if is_url(task.source):
        (folder / "in").mkdir()
        mesh = fetch(task.source, folder / "in")
    own, whole = _digests(mesh)
    record = replace(record, marks=Marks(whole, options_digest(options, task.drawing), terms.version))
    same = task.known is not None and task.known.marks == record.marks
    if same and task.known and task.known.outcome == FAILED and not failed_by_machine(task.known):
        return replace(task.known, kept=True)
    remote = is_url(terms.out)
    target = folder / "out" / PurePosixPath(task.name).name if remote else Path(below(terms.out, task.name))
    there = folder / "there" if remote else target
    if not remote or pull_folder(below(terms.out, task.name), there):
        report = whole_report(there)
        alone = own == whole and task.drawing is None  # its report tells all that it was made of
        if report and (same or alone) and is_finished(report, own, written_options(options), terms.version):
            _keep_thumbnail(there, task)
            before = task.known if same and task.known else record
            return replace(facts_of(report, replace(before, kind="", message="", hint="")), kept=True)
    words = _command(folder, mesh, target, task)
    ended = _run(words, folder, task, cancelled)
    record = _judged(record, ended, task)
    if record.outcome == FAILED:
        return record
    record = facts_of(json.loads(ended.answer), record)
    if remote:
        push_folder(target, below(terms.out, task.name))
    _keep_thumbnail(target, task)
    return record


def _digests(mesh: Path) -> tuple[str, str]:
    """Give the SHA-256 of a file, and of it with all that it names; nothing where it can't be read."""
    with suppress(OSError):
        parts = []
        for path in with_named_files(mesh):
            with path.open("rb") as file:
                parts.append(hashlib.file_digest(file, "sha256").hexdigest())
        whole = parts[0] if len(parts) == 1 else hashlib.sha256("".join(parts).encode()).hexdigest()
        return parts[0], whole
    return "", ""


def _command(folder: Path, mesh: Path, target: Path, task: Task) -> list[str]:
    """Write the options to a file, and give the command line that makes the puzzle."""
    given = {**task.given, "cores": 1, "memory": task.terms.memory}
    (folder / "options.toml").write_text(toml_text(given), "utf-8", "replace")
    if task.drawing is not None:
        (folder / task.drawing.name).write_bytes(task.drawing.data)
    shown = mesh.relative_to(folder).as_posix() if is_url(task.source) else str(mesh)
    words = ["make", "--config", "options.toml", "-o", str(target), "--json", "-q", "--", shown]
    return interpreter_command("meshjig.cli.front", "run_for", str(os.getpid()), str(folder), *words)


def _run(words: Sequence[str], folder: Path, task: Task, cancelled: Callable[[], bool]) -> Ended:
    """Run the command; where another run still writes to its target, once more when that has ended."""
    (folder / "tmp").mkdir()
    environment = os.environ | thread_limits(1) | {"TMPDIR": str(folder / "tmp")}
    limits = GroupLimits(task.terms.seconds, task.terms.memory)
    end = time.monotonic() + _PATIENCE
    while True:
        ended = run_watched(words, limits, folder, environment, cancelled)
        if ended.code != 1 or _BUSY not in ended.said or time.monotonic() > end:
            return ended
        time.sleep(0.5)


def _judged(record: Record, ended: Ended, task: Task) -> Record:
    """Say by the way a command has ended what became of its scan."""
    record = replace(record, peak_mb=round(ended.peak_mb, 1), exit=ended.code)
    if ended.beyond == "time":
        message = f"it took more than the {task.terms.seconds:g} s of --timeout, and was ended"
        return replace(record, kind=TIME, message=message, hint="use fewer faces (--faces)", exit=None)
    if ended.beyond == "memory":
        message = f"its processes held more than the {task.terms.memory:g} GB of --memory, and were ended"
        return replace(record, kind="resources", message=message, hint="use fewer faces (--faces)", exit=5)
    if ended.code in (0, 3):
        return replace(record, outcome=MADE if ended.code == 0 else BROKEN)
    told = _told(ended.answer)
    message = told.get("message") or ended.said.rpartition("\n")[2].removeprefix("meshjig: ")
    number = ended.code - 128 if ended.code > 128 else -ended.code if ended.code < 0 else None
    crash = _CRASH.search(message)
    if number is None and crash:
        number = getattr(signal, _BY_WORD.get(crash[1], crash[1]), None)
    kind = told.get("kind", "killed" if ended.code < 0 else "failure")
    if ended.code < 0:
        message = f"the run was ended by {signal.Signals(-ended.code).name}, perhaps for want of memory"
    if ended.code > 128 or ended.code < 0:
        record = replace(record, exit=None)
    return replace(
        record,
        kind=kind,
        message=message,
        hint=told.get("hint", ""),
        stage=told.get("stage"),
        signal=None if number is None else int(number),
    )


def _told(answer: str) -> Report:
    """Read what --json prints of a failure."""
    with suppress(ValueError, KeyError, TypeError):
        error: Any = json.loads(answer)["error"]
        return dict(error)
    return {}


def _keep_thumbnail(puzzle: Path, task: Task) -> None:
    """Put a small picture of a puzzle among those of the batch, where it is not there yet."""
    place = below(task.terms.out, thumbnail_name(task.name))
    if is_url(place):
        small = puzzle.parent / "thumbnail.jpg"
        if thumbnail(puzzle, small):
            push_file(small, place)
    elif not Path(place).exists() or Path(place).stat().st_mtime < puzzle.stat().st_mtime:
        thumbnail(puzzle, Path(place))
