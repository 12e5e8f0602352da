"""One scan to be made, as a worker is told of it; all of it can be pickled."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import cast

from meshjig.fleet.record import Record
from meshjig.options import OptionKeywords, Options
from meshjig.output.report import report_text

__all__ = ["Drawing", "Task", "Terms", "drawing_of", "options_digest", "written_options"]

_OF_THE_MACHINE = {"cores", "memory"}  # options that change no result
_SVG = ".svg"


@dataclass(frozen=True)
class Terms:
    """What holds for all scans of a batch."""

    out: str  # the folder, a path or a URL
    version: str  # of meshjig
    seconds: float = 900.0  # that a scan may take
    memory: float = 4.0  # GB that its processes may hold


@dataclass(frozen=True)
class Drawing:
    """A user's drawing of tiles, which a worker may have no other way to read."""

    name: str
    data: bytes


@dataclass(frozen=True)
class Task:
    """One scan to be made."""

    name: str
    source: str  # path, absolute, or URL
    given: OptionKeywords  # those that are no defaults
    terms: Terms
    drawing: Drawing | None = None
    known: Record | None = None  # what the journal says became of it
    attempt: int = 1
    refused: str = ""  # what is wrong with its options; then it is not begun


def drawing_of(given: OptionKeywords) -> tuple[OptionKeywords, Drawing | None]:
    """Take the drawing that the option ``tile`` names along with the options.

    Returns
    -------
    The options, with the bare name of the drawing; the drawing, or None.

    Raises
    ------
    OSError
        It can't be read.
    """
    tile = given.get("tile")
    if not tile or not tile.lower().endswith(_SVG):
        return given, None
    before, path = ("", tile) if not tile.startswith("isohedral:") else tile.rsplit(":", 1)
    with open(path, "rb") as file:
        drawing = Drawing(PurePosixPath(path.replace("\\", "/")).name, file.read())
    named = f"{before}:{drawing.name}" if before else drawing.name
    return cast(OptionKeywords, {**given, "tile": named}), drawing


def written_options(options: Options) -> dict[str, object]:
    """Give options as a report holds them, without those that change no result."""
    told = json.loads(report_text(options.model_dump()))
    return {name: value for name, value in told.items() if name not in _OF_THE_MACHINE}


def options_digest(options: Options, drawing: Drawing | None) -> str:
    """Give the SHA-256 of all options that change the result."""
    digest = hashlib.sha256(json.dumps(written_options(options), sort_keys=True).encode())
    if drawing is not None:
        digest.update(drawing.data)
    return digest.hexdigest()
