"""A Dask cluster: one that runs already, or one of this machine's own, set up for work in child processes."""

from __future__ import annotations

import logging
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.machinery import PathFinder
from pathlib import Path
from typing import Any

import meshjig
from meshjig.errors import OptionError, ResourceError
from meshjig.fleet.scratch import scratch_folder, sweep
from meshjig.runtime.messages import tell

__all__ = ["connected", "local_cluster"]

_SETTINGS = {
    "distributed.worker.memory.target": False,  # spilling frees nothing of what native code holds
    "distributed.worker.memory.spill": False,
    "distributed.worker.memory.pause": False,
    "distributed.worker.memory.terminate": False,  # each scan has a limit of its own
    "distributed.scheduler.allowed-failures": 1000,  # who was on a worker as it died is innocent
    "distributed.scheduler.work-stealing": False,
    "distributed.scheduler.worker-ttl": "5 minutes",
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.limit": "60s",
    "distributed.deploy.lost-worker-timeout": "5s",  # after which it may be replaced
}
_TIMEOUT = 30  # s to find a scheduler
_MENDING = 2.0  # s between two looks whether all workers are there


@contextmanager
def local_cluster(workers: int) -> Iterator[Any]:
    """Give a client of a new cluster on this machine: that many processes, a scan at a time each.

    Raises
    ------
    OptionError
        Dask is not installed.
    """
    dask, distributed = _imported()
    _find_ourselves()
    with (
        _told_scratch_folder() as scratch,
        dask.config.set({**_SETTINGS, "temporary-directory": str(scratch)}),
        distributed.LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            memory_limit=0,
            dashboard_address="127.0.0.1:0",  # for nobody else, on whatever port is free
            host="127.0.0.1",
            silence_logs=logging.CRITICAL,
            local_directory=str(scratch),
        ) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
        _kept_whole(cluster, workers),
    ):
        yield client


@contextmanager
def connected(address: str | None, scheduler_file: Path | None) -> Iterator[Any]:
    """Give a client of a cluster that runs already.

    Parameters
    ----------
    address : str, such as tcp://10.0.0.1:8786; or None
    scheduler_file : Path, what ``dask scheduler --scheduler-file`` wrote; or None

    Raises
    ------
    OptionError
        Dask is not installed.
    ResourceError
        No scheduler answers there.
    """
    distributed = _imported()[1]
    where = address or str(scheduler_file)
    if scheduler_file is not None and not scheduler_file.is_file():
        raise OptionError(f"--scheduler-file: {scheduler_file} is no file", hint="start the scheduler first")
    try:
        given = {"scheduler_file": str(scheduler_file)} if scheduler_file else {"address": address}
        client = distributed.Client(**given, timeout=_TIMEOUT, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise ResourceError(
            f"no Dask scheduler answers at {where} ({error or type(error).__name__})",
            hint="start one, or check the address",
        ) from None
    with client:
        yield client


def _imported() -> tuple[Any, Any]:
    try:
        import dask
        import distributed
    except ImportError:
        raise OptionError(
            "batch needs Dask, which is not installed",
            hint="pip install 'meshjig[batch]', or use --shard 1/1, which works one after another without it",
        ) from None
    for name in ("distributed", "tornado", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    return dask, distributed


@contextmanager
def _kept_whole(cluster: Any, workers: int) -> Iterator[None]:
    """Put new workers in the place of those that are lost for good.

    Dask begins a worker anew that dies, but not one that dies as it begins; then nobody would do the work.
    """
    over = threading.Event()

    def mend() -> None:
        for name, nanny in list(cluster.workers.items()):
            if nanny.status.name in ("closed", "failed"):
                del cluster.workers[name]
        cluster.scale(workers)

    def watch() -> None:
        while not over.wait(_MENDING):
            if len(cluster.scheduler_info["workers"]) < workers:
                cluster.loop.add_callback(mend)

    keeper = threading.Thread(target=watch, daemon=True)
    keeper.start()
    try:
        yield
    finally:
        over.set()
        keeper.join()


@contextmanager
def _told_scratch_folder() -> Iterator[Path]:
    """Give a folder that the process in front removes too, should this one be killed."""
    sweep()
    with scratch_folder() as folder:
        tell("scratch", str(folder))
        yield folder


def _find_ourselves() -> None:
    """See that workers, which are fresh interpreters, import the meshjig that runs here."""
    found = PathFinder.find_spec("meshjig", sys.path)
    home = Path(meshjig.__file__).resolve().parent
    if found is None or not found.origin or Path(found.origin).resolve().parent != home:
        sys.path.insert(0, str(home.parent))
