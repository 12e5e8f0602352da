"""A folder for one scan's passing needs; what a killed worker left of such folders goes with the next one."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from meshjig.output.folder.system import acquire

__all__ = ["scratch_folder", "sweep"]

_PREFIX, _LOCK = "meshjig-batch-", ".lock"


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """Give a new folder in the system's place for temporary files, and remove it after the block."""
    folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
    lock = acquire(folder / _LOCK)
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        if lock is not None:
            os.close(lock)


def sweep() -> None:
    """Remove such folders whose owner was killed."""
    for folder in Path(tempfile.gettempdir()).glob(_PREFIX + "*"):
        with suppress(OSError):
            if folder.is_symlink() or folder.stat().st_uid != os.getuid() or not (folder / _LOCK).exists():
                continue
            lock = acquire(folder / _LOCK)
            if lock is not None:
                shutil.rmtree(folder, ignore_errors=True)
                os.close(lock)
