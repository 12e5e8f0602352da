"""A batch of scans: what is missing is made, what is there stays, and everything is written down."""

from __future__ import annotations

import os
from array import array
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any, Unpack, cast

from meshjig.errors import InputError, OptionError
from meshjig.fleet.inputs import Entry, entries, expand
from meshjig.fleet.journal import Journal
from meshjig.fleet.lists import count_rows, read_list
from meshjig.fleet.on_dask import make_on_worker, on_dask
from meshjig.fleet.one_by_one import one_by_one
from meshjig.fleet.places import file_name, is_url
from meshjig.fleet.record import Record, failed_by_machine
from meshjig.fleet.results import write_results
from meshjig.fleet.settings import BatchSettings, Shard
from meshjig.fleet.tally import Tally
from meshjig.fleet.task import Drawing, Task, Terms, drawing_of
from meshjig.options import EITHER, OptionKeywords, Options
from meshjig.runtime.version import meshjig_version

__all__ = ["Batch", "batch"]

_MEMORY = 4.0  # GB that a scan may take where nothing is said
_NOWHERE = 2**64 - 1  # stands for a scan that nothing was written of


class Batch:
    """Scans to be made, and a folder for them; to iterate over it does the work.

    Parameters
    ----------
    inputs : sequence of str; see `batch`
    out : str
    client : distributed.Client, optional
    settings : BatchSettings
    given : options, those that are no defaults

    Raises
    ------
    MeshjigError
        See `batch`.
    """

    def __init__(
        self,
        inputs: Sequence[str],
        out: str,
        client: Any,
        settings: BatchSettings,
        given: OptionKeywords,
    ) -> None:
        self.client, self.settings, self.tally = client, settings, Tally()
        options = Options.of(**given)
        if os.name != "posix":
            raise OptionError("batch needs process groups, which Windows has not", hint="run it under WSL")
        self.out = out if is_url(out) else os.path.abspath(out)
        if os.path.lexists(self.out) and not os.path.isdir(self.out) and not is_url(out):
            raise OptionError(f"{out} is a file, not a folder", hint="choose another with -o")
        self.terms = Terms(self.out, meshjig_version(), settings.timeout, options.memory or _MEMORY)
        self._given = given
        self._drawing = _taken_along(given)
        self._inputs = expand(inputs, self.out)
        if settings.listed is None and not self._inputs:
            raise InputError("there is no scan", hint="give files, folders, patterns, or a list with --from")
        if settings.listed is not None:
            read_list(settings.listed)  # refuses what is none
        self.journal_path = settings.journal or _journal_of(self.out, settings.shard)
        self.function: Callable[[Task], Record] = make_on_worker

    def total(self) -> int:
        """Give about how many scans there are, of this share."""
        n = len(self._inputs) + (count_rows(self.settings.listed) if self.settings.listed else 0)
        return -(-(n - self.settings.shard.number + 1) // self.settings.shard.of)

    def __iter__(self) -> Iterator[Record]:
        """Do the work, and give what becomes of each scan, in the order in which it is known."""
        shard, places = self.settings.shard, array("Q")
        journal = Journal(self.journal_path, _other_journals(self.journal_path))
        try:
            journal.append("begin", {"version": self.terms.version, "shard": f"{shard.number}/{shard.of}"})
            work = _Work(self._tasks(journal))
            results = (
                one_by_one(work.next)
                if self.client is None
                else on_dask(self.client, work.next, self.settings.window, self.function)
            )
            for task, record in results:
                if failed_by_machine(record) and task.attempt <= self.settings.retries:
                    journal.append("retry", record.as_dict())
                    self.tally.retried += 1
                    work.again(task)
                    continue
                number = work.number_of(task)
                places.extend([_NOWHERE] * (number + 1 - len(places)))
                places[number] = journal.keep(record)
                self.tally.add(record)
                yield record
            written = [place for place in places if place != _NOWHERE] if _NOWHERE in places else places
            write_results(self.out, shard.name, lambda: journal.records(written), self.tally)
            journal.append("end", self.tally.as_dict())
        finally:
            journal.close()

    def _tasks(self, journal: Journal) -> Iterator[Task]:
        rows = read_list(self.settings.listed) if self.settings.listed else iter(())
        shard = self.settings.shard
        for name, entry in islice(entries(self._inputs, rows), shard.number - 1, None, shard.of):
            yield replace(self._task(name, entry), known=journal.find(name))

    def _task(self, name: str, entry: Entry) -> Task:
        given, drawing = self._drawing
        if not entry.given:
            return Task(name, entry.source, given, self.terms, drawing)
        own = {key: value for key, value in self._given.items() if EITHER.get(key) not in entry.given}
        both = cast(OptionKeywords, {**own, **entry.given})
        try:
            options = Options.of(**both)
            given, drawing = _taken_along(both)
        except OptionError as error:
            return Task(name, entry.source, given, self.terms, refused=f"{entry.where}: {error}")
        terms = replace(self.terms, memory=options.memory or _MEMORY)
        return Task(name, entry.source, given, terms, drawing)


class _Work:
    """Tasks that wait: those to be tried again first, then those of the list."""

    def __init__(self, tasks: Iterator[Task]) -> None:
        self._tasks, self._waiting = enumerate(tasks), deque[Task]()
        self._numbers: dict[str, int] = {}  # of what is under way

    def next(self) -> Task | None:
        """Give the next one, or None where none waits at the moment."""
        if self._waiting:
            return self._waiting.popleft()
        number, task = next(self._tasks, (0, None))
        if task is not None:
            self._numbers[task.name] = number
        return task

    def again(self, task: Task) -> None:
        """Have a task tried once more."""
        self._waiting.append(replace(task, attempt=task.attempt + 1, known=None))

    def number_of(self, task: Task) -> int:
        """Give the place in the list of a task that is done."""
        return self._numbers.pop(task.name)


def batch(
    inputs: Sequence[str | os.PathLike[str]],
    out: str | os.PathLike[str],
    *,
    client: Any = None,
    settings: BatchSettings | None = None,
    **options: Unpack[OptionKeywords],
) -> Iterator[Record]:
    """Make puzzles of many scans, each in a process of its own, and give the records as they come.

    What is there already, made of the same bytes with the same options by the same version, is kept, and so
    is what is known to fail. ``batch.jsonl`` in the folder is the journal; at the end ``summary.csv`` and
    ``index.html`` are written there. Nothing is begun before the first record is asked for.

    Parameters
    ----------
    inputs : sequence of paths of files and folders, patterns, and URLs that fsspec reads
    out : path or URL, a folder that gets one for each scan
    client : distributed.Client, optional
        Of the cluster that does the work; without one, scans are made one after another from here.
    settings : BatchSettings, optional
    **options
        The fields of `Options`; ``memory``, in GB, is 4 a scan if not given, ``cores`` is 1.

    Returns
    -------
    iterator of Record

    Raises
    ------
    InputError
        There is no scan.
    OptionError
        An option is wrong.
    OutputError
        The journal can't be written, or another batch is writing to it.
    ResourceError
        The scheduler is gone.
    """
    named = [os.fspath(one) for one in inputs]
    return iter(Batch(named, os.fspath(out), client, settings or BatchSettings(), options))


def _taken_along(given: OptionKeywords) -> tuple[OptionKeywords, Drawing | None]:
    try:
        return drawing_of(given)
    except OSError as error:
        says = f"tile: {given.get('tile')} can't be read ({error.strerror})"
        raise OptionError(says, hint="check the name", option="tile") from None


def _journal_of(out: str, shard: Shard) -> Path:
    """Give where the journal is: beside the puzzles, or in the current folder where these are elsewhere."""
    if is_url(out):
        return Path(shard.name(f"{file_name(out) or 'bucket'}.batch.jsonl"))
    return Path(out) / shard.name("batch.jsonl")


def _other_journals(own: Path) -> list[Path]:
    """List journals of other shards beside one."""
    if not own.name.startswith("batch"):
        return []
    return sorted(path for path in own.parent.glob("batch*.jsonl") if path != own)
