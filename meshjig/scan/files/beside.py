"""Files that a mesh file names, found beside it: regular ones only."""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterable, Iterator
from pathlib import Path
from urllib.parse import unquote

from meshjig.errors import InputError
from meshjig.runtime.bounded import allow_file

__all__ = ["find_beside", "read_beside", "short"]

_LONG = 80  # letters of a name in a sentence


def find_beside(path: Path, name: str) -> Path | None:
    """Find a file that a mesh file names.

    Its name may be percent-encoded or have backslashes, or be in Latin-1 on the disk. Where nothing is there,
    a file of that name beside the mesh file is meant, in letters of whatever case: folders are those of
    whoever wrote it.

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
    spellings = [name, unquote(name), name.replace("\\", "/"), unquote(name.replace("\\", "/"))]
    spellings += [old for spelt in spellings for old in _in_latin_1(spelt)]
    for spelt in dict.fromkeys([*spellings, *_alike(path, spellings[2:])]):
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


def _in_latin_1(name: str) -> list[str]:
    """Give how a name reads whose bytes on the disk are Latin-1, as old programs and archives leave them."""
    try:
        return [] if name.isascii() else [os.fsdecode(name.encode("latin-1"))]
    except ValueError:
        return []


def _alike(path: Path, spellings: Iterable[str]) -> Iterator[str]:
    """Names of files beside a mesh file that differ from some by folders, or by the case of letters, only."""
    last = {spelt.rsplit("/", 1)[-1].lower() for spelt in spellings} - {""}
    with contextlib.suppress(OSError, ValueError):
        yield from sorted(name for name in os.listdir(path.parent) if name.lower() in last)


def read_beside(path: Path, name: str, first: Path | None = None) -> bytes | None:
    """Read a file that `find_beside` finds; limits of memory and time are raised by its size.

    Parameters
    ----------
    path : Path, of the mesh file
    name : str, as it stands there, or in the other file
    first : Path, optional
        Of another file, such as one of materials: what it names is looked for beside it first.

    Returns
    -------
    bytes, or None where there is no such file

    Raises
    ------
    InputError
        It is no regular file, or can't be opened.
    """
    found = find_beside(first, name) if first is not None else None
    found = found or find_beside(path, name)
    if found is None:
        return None
    allow_file(found)
    try:
        return found.read_bytes()
    except OSError as error:
        raise InputError(f"{path} names {found.name}, which can't be opened ({error.strerror})") from None


def short(name: str) -> str:
    """Give a name as it stands in a sentence, cut where it is very long."""
    return name if len(name) <= _LONG else f"{name[:_LONG]}..."
