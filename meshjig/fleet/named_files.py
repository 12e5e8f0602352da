"""Files that a mesh file names, such as materials and pictures: where it goes, they go along."""

from __future__ import annotations

import mmap
import re
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

__all__ = ["names_in", "with_named_files"]

_OF = {
    ".obj": re.compile(rb"(?m)^mtllib[ \t]+(.+?)[ \t\r]*$"),
    ".mtl": re.compile(rb"(?mi)^[ \t]*map_k[ad][ \t]+(.+?)[ \t\r]*$"),
    ".gltf": re.compile(rb'"uri"\s*:\s*"((?!data:)[^"]+)"'),
    ".ply": re.compile(rb"(?m)^comment TextureFile[ \t]+(.+?)[ \t\r]*$"),
}
_HEAD = 1 << 16  # bytes of a PLY file in which its header is
_MOST = 1000  # files that one names


def names_in(path: Path) -> list[str]:
    """List what a file names, where that is below its own folder; as it may be spelt on the disk.

    A name may be the last words of a line, or all of them: those that are not there do no harm.
    """
    pattern = _OF.get(path.suffix.lower())
    if pattern is None or not path.is_file() or not path.stat().st_size:
        return []
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        most = _HEAD if path.suffix.lower() == ".ply" else len(data)
        found = []
        for match in pattern.finditer(data, 0, most):
            text = match[1].decode("utf-8", "replace").strip("\"' ")
            found += [text, unquote(text), text.rsplit(" ", 1)[-1]]
            if len(found) > 3 * _MOST:
                break
    names = dict.fromkeys(name.replace("\\", "/") for name in found)
    return [name for name in names if _is_below(name)]


def with_named_files(path: Path, provide: Callable[[str], None] | None = None) -> list[Path]:
    """List a mesh file and the files that it names, and those that these name, if they are there.

    Parameters
    ----------
    path : Path
    provide : callable, optional
        Called with each name, relative to the file's folder, before it is looked for.
    """
    found, waiting = [path], names_in(path)
    seen = set(waiting)
    while waiting:
        name = waiting.pop(0)
        if provide is not None:
            provide(name)
        beside = path.parent / name
        with suppress(OSError, ValueError):
            if beside.is_file():
                found.append(beside)
                new = [other for other in names_in(beside) if other not in seen]
                seen.update(new)
                waiting += new
    return found


def _is_below(name: str) -> bool:
    parts = PurePosixPath(name).parts
    return (
        bool(parts)
        and ".." not in parts
        and not name.startswith("/")
        and ":" not in name
        and "\0" not in name
    )
