"""A single text file that appears whole or not at all, and replaces none that somebody else wrote."""

from __future__ import annotations

import hashlib
import os
import re
import uuid
from contextlib import suppress
from pathlib import Path

from meshjig.errors import OutputError, write_error

__all__ = ["write_svg_file"]

_MARK = re.compile(rb"<!-- made by meshjig, sha256 ([0-9a-f]{64}) -->\n\Z")


def write_svg_file(path: Path, text: str) -> None:
    """Write an SVG drawing, with a last line by which its next version knows that it may replace it.

    Parameters
    ----------
    path : Path
        An existing file is replaced only when this function wrote it, and it was not changed since.
    text : str, ends with a line break

    Raises
    ------
    OutputError
        The file can't be written, or is not ours to replace.
    """
    path = Path(os.path.realpath(path))
    scratch = path.with_name(f".meshjig-{uuid.uuid4().hex[:12]}.svg")
    try:
        if os.path.lexists(path) and not _is_ours(path):
            raise OutputError(
                f"{path} was not written by meshjig, or was changed since",
                hint="choose another file with --svg",
            )
        data = text.encode("utf-8")
        mark = f"<!-- made by meshjig, sha256 {hashlib.sha256(data).hexdigest()} -->\n"
        scratch.write_bytes(data + mark.encode("ascii"))
        os.replace(scratch, path)
    except OSError as error:
        raise write_error(str(path), error, "choose another file with --svg, or make room there") from None
    finally:
        with suppress(OSError):
            scratch.unlink()


def _is_ours(path: Path) -> bool:
    if not path.is_file() or path.stat().st_size > 100_000_000:
        return False
    data = path.read_bytes()
    mark = _MARK.search(data)
    return mark is not None and hashlib.sha256(data[: mark.start()]).hexdigest().encode() == mark[1]
