"""Files that a mesh file names, found beside it: regular ones only."""

from __future__ import annotations

import stat
from pathlib import Path
from urllib.parse import unquote

from meshjig.errors import InputError
from meshjig.runtime.bounded import allow_file

__all__ = ["find_beside", "read_beside"]


def find_beside(path: Path, name: str) -> Path | None:
    """Find a file that a mesh file names, be its name percent-encoded or with backslashes.

    Parameters
    ----------
    path : Path, of the mesh file
    name : str, as it stands there

    Returns
    -------
    Path, or None where there is none

    Raises
    ------
    InputError
        It is a pipe or a device, on which reading would wait for ever.
    """
    for spelt in dict.fromkeys(
        [name, unquote(name), name.replace("\\", "/"), unquote(name.replace("\\", "/"))]
    ):
        try:
            found = path.parent / spelt
            mode = found.stat().st_mode
        except (OSError, ValueError):
            continue
        if stat.S_ISDIR(mode):
            continue
        if not stat.S_ISREG(mode):
            raise InputError(
                f"{path} names {found.name}, which is no regular file", hint="put the file itself there"
            )
        return found
    return None


def read_beside(path: Path, name: str) -> bytes | None:
    """Read a file that `find_beside` finds; limits of memory and time are raised by its size.

    Raises
    ------
    InputError
        It is no regular file, or can't be opened.
    """
    found = find_beside(path, name)
    if found is None:
        return None
    allow_file(found)
    try:
        return found.read_bytes()
    except OSError as error:
        raise InputError(f"{path} names {found.name}, which can't be opened ({error.strerror})") from None
