"""Scans handed to the workers of a Dask cluster, a window of them at a time."""

from __future__ import annotations

import queue
import uuid
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from typing import Any

from meshjig.errors import ResourceError
from meshjig.fleet.make_scan import make_scan, never
from meshjig.fleet.record import FAILED, LOST, Record
from meshjig.fleet.task import Task

__all__ = ["make_on_worker", "on_dask"]

_EVERY = 1.0  # s between two looks at the scheduler, where no scan comes back
_AT_ONCE = 256  # records that are fetched together

_OVER = {"finished", "error", "cancelled"}  # of a future
_ENDED = {"closed", "closing", "failed", "stopping", "stopped"}


def on_dask(
    client: Any,
    next_task: Callable[[], Task | None],
    window: int,
    function: Callable[[Task], Record],
) -> Iterator[tuple[Task, Record]]:
    """Have scans made by workers, and give what became of each as it comes back.

    Parameters
    ----------
    client : distributed.Client
    next_task : callable
        Gives the next scan, or None where there is none at the moment.
    window : int, how many the scheduler knows of at a time
    function : callable, what a worker does; see `make_on_worker`

    Raises
    ------
    ResourceError
        The scheduler is gone.
    """
    done: queue.SimpleQueue[Any] = queue.SimpleQueue()
    under_way: dict[str, tuple[Any, Task]] = {}
    try:
        while True:
            while len(under_way) < window and (task := next_task()) is not None:
                future = client.submit(function, task, key=f"meshjig-{uuid.uuid4().hex}", pure=False)
                under_way[future.key] = (future, task)
                future.add_done_callback(done.put)
            if not under_way:
                return
            for future, record in _come_back(client, done):
                task = under_way.pop(future.key)[1]
                future.release()
                yield task, _lost(task, record) if isinstance(record, BaseException) else record
    finally:
        with suppress(Exception):  # the scheduler may be gone
            client.cancel([future for future, _ in under_way.values()])


def _come_back(client: Any, done: queue.SimpleQueue[Any]) -> list[tuple[Any, Any]]:
    """Wait for futures that are done, and give them with their records, or with what was raised."""
    ready: list[Any] = []
    while not ready:
        with suppress(queue.Empty):
            ready.append(done.get(timeout=_EVERY))
        if not ready and client.status != "running":
            raise _gone(client)
    with suppress(queue.Empty):
        while len(ready) < _AT_ONCE:
            ready.append(done.get_nowait())
    for future in ready:
        if future.status not in _OVER:  # its record went with its worker
            future.add_done_callback(done.put)
    ready = [future for future in ready if future.status in _OVER]
    if any(future.status == "cancelled" for future in ready):
        raise _gone(client)
    sound = [future for future in ready if future.status == "finished"]
    try:
        records = client.gather(sound, errors="raise") if sound else []
    except Exception as error:
        if client.status != "running":
            raise _gone(client) from None
        records = [error] * len(sound)  # their worker died with them
    failed = [future for future in ready if future not in sound]
    return [*zip(sound, records, strict=True), *((future, future.exception()) for future in failed)]


def _gone(client: Any) -> ResourceError:
    return ResourceError(
        f"the scheduler at {client.scheduler.address if client.scheduler else 'its address'} is gone",
        hint="start one, and give the same command again: it goes on where it ended",
    )


def _lost(task: Task, error: BaseException) -> Record:
    """Give the record of a scan whose worker was lost."""
    reason = f"{type(error).__name__}: {error}".splitlines()[0]
    message = f"its worker was lost, or could not run it ({reason})"
    record = Record(task.name, task.source, FAILED, LOST, message, attempts=task.attempt)
    return record if task.known is None else replace(record, marks=task.known.marks)


def make_on_worker(task: Task) -> Record:
    """Make a scan on a worker; once the client or the scheduler is gone, end it."""
    return make_scan(task, _cancelled_by_dask())


def _cancelled_by_dask() -> Callable[[], bool]:
    """Give what tells whether this worker's current task is cancelled, or the worker is closing."""
    from distributed import get_worker

    try:
        worker = get_worker()
        key = worker.get_current_task()
    except (ValueError, RuntimeError):  # no worker's thread
        return never

    def cancelled() -> bool:
        state = worker.state.tasks.get(key)
        return state is None or state.state == "cancelled" or worker.status.name in _ENDED

    return cancelled
