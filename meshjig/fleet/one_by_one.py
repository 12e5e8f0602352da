"""Scans one after another, in this process: for a share of a batch that others divide."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from meshjig.fleet.make_scan import make_scan
from meshjig.fleet.record import Record
from meshjig.fleet.task import Task

__all__ = ["one_by_one"]


def one_by_one(next_task: Callable[[], Task | None]) -> Iterator[tuple[Task, Record]]:
    """Make scans as long as there are any, and give what became of each."""
    while (task := next_task()) is not None:
        yield task, make_scan(task)
