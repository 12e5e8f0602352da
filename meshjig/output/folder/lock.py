"""A file lock that dies with its owner."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from pathlib import Path

__all__ = ["acquire", "release"]


def acquire(path: Path) -> int | None:
    """Take the lock that a file stands for; the file is made where it is not there.

    Returns
    -------
    int
        A file descriptor to read and write; the lock ends with it, however the process ends. None where
        somebody else holds the lock.

    Raises
    ------
    OSError
        The file can't be made.
    """
    while True:
        file = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
        if not _lock(file):
            os.close(file)
            return None
        with suppress(FileNotFoundError):
            if os.path.samestat(os.fstat(file), path.lstat()):
                return file
        os.close(file)  # its last owner has just removed it


def release(path: Path, file: int) -> None:
    """Give the lock back, and remove its file."""
    if sys.platform == "win32":  # which removes no open file
        os.close(file)
    with suppress(OSError):
        path.unlink()
    if sys.platform != "win32":
        os.close(file)


def _lock(file: int) -> bool:
    """Lock an open file; a file system without locks counts as locked."""
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        return True
    return True
