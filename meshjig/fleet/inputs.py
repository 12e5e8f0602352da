"""The scans that words of a command line stand for: files, folders, patterns and URLs; and their names."""

from __future__ import annotations

import glob
import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from meshjig.errors import InputError
from meshjig.fleet.names import Names
from meshjig.fleet.places import is_url, reach

__all__ = ["Entry", "entries", "expand"]

_MESHES = {".stl", ".obj", ".ply", ".off", ".glb", ".gltf", ".3mf"}
_MAGIC = set("*?[")


class Entry(NamedTuple):
    """A scan, before it has a name."""

    source: str  # path, absolute, or URL
    relative: str  # its path below what was given
    given: Mapping[str, str] = {}  # options of its own
    where: str = ""  # in a list, for sentences


def expand(inputs: Sequence[str], out: str) -> list[Entry]:
    """Find the scans that words of a command line stand for, sorted within each.

    Parameters
    ----------
    inputs : paths of files and folders, patterns, URLs of files, of folders (they end with a slash), and of
        patterns
    out : str, the folder of the batch; what lies in it is no scan

    Raises
    ------
    InputError
        One stands for nothing.
    """
    found = []
    for given in inputs:
        some = list(_of_url(given) if is_url(given) else _of_path(given, os.path.abspath(out)))
        if not some:
            raise InputError(f"{given} holds no scan", hint=f"known are {', '.join(sorted(_MESHES))}")
        found += some
    return found


def entries(inputs: Sequence[Entry], rows: Iterable[Entry]) -> Iterator[tuple[str, Entry]]:
    """Give every scan its name, in their order.

    Where several of the inputs have a name, all keep their relative paths. Of a list, which is read as it is
    used, the first has the name.
    """
    names = Names()
    for stem, n in Counter(Path(entry.relative).stem.casefold() for entry in inputs).items():
        if n > 1:
            names.share(stem)
    for entry in inputs:
        yield names.give(entry.relative), entry
    for entry in rows:
        yield names.give(entry.relative), entry


def _of_path(given: str, out: str) -> Iterator[Entry]:
    if os.path.isdir(given):
        for above, folders, files in os.walk(given, followlinks=True):
            folders[:] = sorted(
                name
                for name in folders
                if not name.startswith(".") and os.path.abspath(os.path.join(above, name)) != out
            )
            for name in sorted(files):
                if _is_mesh(name) and not name.startswith("."):
                    path = os.path.join(above, name)
                    yield Entry(os.path.abspath(path), os.path.relpath(path, given).replace(os.sep, "/"))
    elif _MAGIC & set(given) and not os.path.lexists(given):
        root = _fixed(given)
        for path in sorted(glob.glob(given, recursive=True)):
            if os.path.isfile(path):
                yield Entry(os.path.abspath(path), os.path.relpath(path, root).replace(os.sep, "/"))
    else:
        yield Entry(os.path.abspath(given), given.replace(os.sep, "/"))


def _of_url(given: str) -> Iterator[Entry]:
    listed = given.endswith("/") or bool(_MAGIC & set(given.partition("://")[2]))
    if not listed or given.startswith(("http://", "https://")):
        yield Entry(given, given.partition("://")[2])
        return
    system, path = reach(given)
    scheme = given.partition("://")[0]
    root = _fixed(path) if _MAGIC & set(path) else path.rstrip("/")
    try:
        found = system.glob(path) if _MAGIC & set(path) else system.find(path)
    except (OSError, ValueError) as error:
        raise InputError(f"{given} can't be listed ({error})", hint="check the URL") from None
    for one in sorted(map(str, found)):
        if _is_mesh(one):
            yield Entry(f"{scheme}://{one}", one.removeprefix(root).lstrip("/"))


def _fixed(pattern: str) -> str:
    """Give the folder above the first part of a pattern that can vary."""
    parts = pattern.split("/")
    fixed = next(i for i, part in enumerate(parts) if _MAGIC & set(part))
    return "/".join(parts[:fixed]) or ("/" if pattern.startswith("/") else ".")


def _is_mesh(name: str) -> bool:
    return os.path.splitext(name)[1].lower() in _MESHES
