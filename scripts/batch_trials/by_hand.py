"""A Dask cluster whose processes are started by hand, each in a folder of its own."""

import os
import subprocess
import sys
from pathlib import Path

_NO_LIMITS = {
    f"DASK_DISTRIBUTED__WORKER__MEMORY__{name}": "False" for name in ("TARGET", "SPILL", "PAUSE", "TERMINATE")
}


def dask(folder: Path, *words: object, **environment: str) -> subprocess.Popen:
    """Start a command of Dask in a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "log").open("a") as log:
        return subprocess.Popen(
            [sys.executable, "-m", "dask", *map(str, words)],
            cwd=folder,
            stdout=log,
            stderr=log,
            env=os.environ | _NO_LIMITS | {"DASK_TEMPORARY_DIRECTORY": str(folder)} | environment,
        )


def scheduler(folder: Path, port: int) -> subprocess.Popen:
    """Start a scheduler on a loopback port."""
    words = ("scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard", "--no-show")
    return dask(folder, *words, DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES="100")


def worker(folder: Path, port: int, **environment: str) -> subprocess.Popen:
    """Start a worker of one thread."""
    words = ("worker", f"tcp://127.0.0.1:{port}", "--nthreads", 1, "--memory-limit", 0, "--no-dashboard")
    return dask(folder, *words, "--host", "127.0.0.1", "--death-timeout", 60, **environment)
