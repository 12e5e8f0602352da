"""What a mesh file holds, and how much of it was read."""

from __future__ import annotations

from typing import NamedTuple

from meshjig.scan.source import Source

__all__ = ["FileMesh"]


class FileMesh(NamedTuple):
    """What a file holds."""

    source: Source
    reader: str
    notes: list[str]  # a sentence for everything that was left out
    announced: int = 0  # how many faces the file says it has, polygons as one
    found: int = 0  # how many of these were read
    sha256: str = ""  # of the file's bytes; of those of files that it names, nothing
