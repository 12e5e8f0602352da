"""What memory and time a large file will take to be read and simplified, said before it is."""

from __future__ import annotations

import logging
import os
import re
from pathlib import Path
from typing import Any, NamedTuple

from meshjig.errors import ResourceError
from meshjig.runtime.bounded import ReadAhead

__all__ = ["Forecast", "foresee", "foretell"]

_told = logging.getLogger("meshjig.told")

_WORTH_SAYING = 500_000  # faces
_SAMPLE = 1 << 16  # bytes, of which a file of text is looked at in several places
_SAMPLES = 8
_MEMORY, _SECONDS = 250e6, 2.0  # bytes of the run and its reader, and s, for a mesh of no size
_MEMORY_A_FACE = {"stl": 600.0}  # bytes; STL holds each vertex six times
_SECONDS_A_FACE = {"stl": 5.5e-6, "obj": 5e-6}
_OTHERS = 340.0, 3.5e-6


class Forecast(NamedTuple):
    """What it takes to read a file, to clean it, and to simplify it to 100,000 faces."""

    faces: int  # as the file says, or as its size lets one guess
    memory: float  # bytes, resident, at most, of the run and of the process that reads
    seconds: float  # on a quiet machine


def foresee(path: Path) -> Forecast | None:
    """Guess what a file will take, by its size and what it announces; None where nothing can be said.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Forecast or None
    """
    kind = path.suffix.lower().lstrip(".")
    count = {"stl": _stl, "obj": _obj, "ply": _ply, "off": _off}.get(kind)
    try:
        faces = count(path) if count else None
    except OSError:  # its reader says what is wrong
        return None
    if faces is None:
        return None
    memory = _MEMORY + faces * _MEMORY_A_FACE.get(kind, _OTHERS[0])
    return Forecast(faces, memory, _SECONDS + faces * _SECONDS_A_FACE.get(kind, _OTHERS[1]))


def foretell(source: Any, most: float | None = None) -> None:
    """Say what a large file will take, and refuse one that would take more memory than it may.

    Parameters
    ----------
    source : path, ReadAhead, or a mesh, of which nothing is said
    most : float, GB of memory

    Raises
    ------
    ResourceError
        The sentence says how much it would take.
    """
    if isinstance(source, ReadAhead):
        source = source.path
    if not isinstance(source, str | os.PathLike) or (found := foresee(Path(source))) is None:
        return
    takes = f"{source} has about {found.faces:,} faces: about {found.memory / 1e9:.1f} GB of memory"
    if most is not None and found.memory > most * 1e9:
        raise ResourceError(
            f"{takes} to be read, more than the {most:g} GB of --memory",
            hint="export it with fewer faces, or allow more",
        )
    if found.faces >= _WORTH_SAYING:
        _told.info("%s and %.0f s to be read and simplified", takes, found.seconds)


def _stl(path: Path) -> int | None:
    with path.open("rb") as file:
        head = file.read(512)
    text = head[:5].lower() == b"solid" and b"facet" in head
    return (
        None if len(head) < 84 else path.stat().st_size // 260 if text else (path.stat().st_size - 84) // 50
    )


def _obj(path: Path) -> int | None:
    """Count triangles in some places of the file: n corners make n - 2."""
    size, faces, looked = path.stat().st_size, 0, 0
    with path.open("rb") as file:
        for k in range(_SAMPLES):
            file.seek(k * max(0, size - _SAMPLE) // max(1, _SAMPLES - 1))
            part = file.read(_SAMPLE)
            looked += len(part)
            faces += sum(
                max(0, len(line.split()) - 3) for line in re.findall(rb"^f\s.*$", part, re.MULTILINE)
            )
    return round(faces * size / looked) if looked else None


def _ply(path: Path) -> int | None:
    with path.open("rb") as file:
        found = re.search(rb"^element face (\d{1,12})\s", file.read(1 << 16), re.MULTILINE)
    return int(found[1]) if found else None


def _off(path: Path) -> int | None:
    with path.open("rb") as file:
        found = re.match(rb"[A-Z4n]*OFF\s+(?:#[^\n]*\n\s*)*\d+\s+(\d{1,12})\s", file.read(1 << 12))
    return int(found[1]) if found else None
