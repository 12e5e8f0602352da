"""A file lock that dies with its owner."""

from __future__ import annotations

import ctypes
import errno
import os
import sys
from contextlib import suppress
from pathlib import Path

__all__ = ["acquire", "exchange", "release"]


_HERE = -100  # AT_FDCWD: paths are those of the process
_LINUX_EXCHANGE = 2  # RENAME_EXCHANGE of renameat2(2)
_MACOS_SWAP = 2  # RENAME_SWAP of renamex_np(2)
_UNABLE = (errno.EINVAL, errno.ENOSYS, errno.ENOTSUP, errno.EPERM)  # by the kernel, or by the file system


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


def exchange(one: Path, other: Path) -> bool:
    """Let two folders of one file system change places, so that no moment has only one of them.

    Returns
    -------
    bool
        False where the system or the file system has no such step; then nothing has happened. Linux has it
        (ext4, xfs, btrfs, tmpfs, overlayfs), macOS on APFS; Windows has not.

    Raises
    ------
    OSError
        The step failed.
    """
    if sys.platform == "win32":
        return False
    system = ctypes.CDLL(None, use_errno=True)
    paths = os.fsencode(one), os.fsencode(other)
    try:
        if sys.platform == "darwin":
            failed = system.renamex_np(*paths, _MACOS_SWAP)
        else:
            failed = system.renameat2(_HERE, paths[0], _HERE, paths[1], _LINUX_EXCHANGE)
    except AttributeError:  # an old C library
        return False
    if not failed:
        return True
    code = ctypes.get_errno()
    if code in _UNABLE:
        return False
    raise OSError(code, os.strerror(code), str(other))
