"""Two folders change places in one step, where the system can do it."""

from __future__ import annotations

import ctypes
import errno
import os
import sys
from pathlib import Path

__all__ = ["exchange"]

_HERE = -100  # AT_FDCWD: paths are those of the process
_LINUX_EXCHANGE = 2  # RENAME_EXCHANGE of renameat2(2)
_MACOS_SWAP = 2  # RENAME_SWAP of renamex_np(2)
_UNABLE = (errno.EINVAL, errno.ENOSYS, errno.ENOTSUP, errno.EPERM)  # by the kernel, or by the file system


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
