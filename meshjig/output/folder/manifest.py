"""Which files of a folder meshjig wrote, by the report that lists them with their SHA-256."""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from meshjig.errors import OutputError
from meshjig.output.report import report_file

__all__ = ["REPORT", "Manifest", "discard", "read_manifest", "sign", "stranger"]

REPORT = "report.json"
_UNSIGNED = "0" * 64  # stands for the report's own digest, which can't be part of what it is made of


class Manifest(NamedTuple):
    """What a folder came with."""

    kind: str  # of folder, such as "puzzle"
    files: dict[str, str]  # path below the folder -> SHA-256


def sign(folder: Path) -> None:
    """Add to the report of a folder the list ``files`` of all that is in it.

    Raises
    ------
    OSError
        A file can't be read or written.
    """
    path = folder / REPORT
    report = json.loads(path.read_text(encoding="utf-8"))
    names = sorted(file.relative_to(folder).as_posix() for file in folder.rglob("*") if file.is_file())
    digests = {name: _digest(folder / name) for name in names if name != REPORT}
    report["files"] = digests | {REPORT: _UNSIGNED}
    text = json.dumps(report, indent=2, ensure_ascii=False) + "\n"
    own = hashlib.sha256(text.encode()).hexdigest()
    path.write_text(text.replace(_UNSIGNED, own), encoding="utf-8")


def read_manifest(folder: Path) -> Manifest | None:
    """Give what the report of a folder lists; None where meshjig wrote no report there, or an unsigned one.

    Notes
    -----
    A report that was changed since does not list itself any more; see `stranger`.
    """
    path = folder / REPORT
    try:
        if path.is_symlink():
            return None
        text = report_file(path)
        report = json.loads(text)
        files = {str(name): str(digest) for name, digest in report["files"].items()}
        kind = str(report["kind"])
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    own = files.pop(REPORT, "")
    unsigned = text.replace(own, _UNSIGNED) if len(own) == len(_UNSIGNED) else ""
    if hashlib.sha256(unsigned.encode()).hexdigest() == own:
        files[REPORT] = hashlib.sha256(text.encode()).hexdigest()
    return Manifest(kind, files)


def stranger(folder: Path, manifest: Manifest | None) -> tuple[Path, str] | None:
    """Find something in a folder that is not ours to remove, and say what it is; None where all is.

    Raises
    ------
    OSError
        The folder can't be read.
    """
    files = {} if manifest is None else manifest.files
    homes = {str(above) for name in files for above in Path(name).parents}
    for entry in _entries(folder):
        name = entry.relative_to(folder).as_posix()
        if stat.S_ISDIR(entry.lstat().st_mode):
            if name not in homes:
                return entry, "was not made by meshjig"
        elif name not in files:
            return entry, "was changed since meshjig wrote it" if name == REPORT else _NOT_OURS
        elif not _is_as_written(entry, files[name]):
            return entry, "was changed since meshjig wrote it"
    return None


_NOT_OURS = "was not written by meshjig"


def discard(folder: Path) -> None:
    """Remove a folder that meshjig made, and of what it holds only what meshjig wrote.

    Raises
    ------
    OutputError
        Something else is there; it is left.
    """
    manifest = read_manifest(folder)
    files = {} if manifest is None else manifest.files
    report = files.pop(REPORT, "")
    for name in files:
        _remove(folder / name, files[name])
    homes = {folder / above for name in files for above in Path(name).parents} - {folder}
    for home in sorted(homes, key=lambda home: -len(home.parts)):
        with suppress(OSError):
            home.rmdir()
    _remove(folder / REPORT, report)  # the list goes last, so that this can be taken up again
    with suppress(OSError):
        folder.rmdir()
    if folder.exists():
        raise OutputError(f"{folder} holds files that meshjig did not write", hint="look through them")


def _entries(folder: Path) -> Iterator[Path]:
    """Give what is in a folder, and in the folders in it; a folder before what it holds."""
    with os.scandir(folder) as entries:
        found = sorted(entries, key=lambda entry: entry.name)
    for entry in found:
        yield Path(entry.path)
        if entry.is_dir(follow_symlinks=False):
            yield from _entries(Path(entry.path))


def _remove(path: Path, digest: str) -> None:
    with suppress(OSError):
        if _is_as_written(path, digest):
            path.unlink()


def _is_as_written(path: Path, digest: str) -> bool:
    return stat.S_ISREG(path.lstat().st_mode) and _digest(path) == digest


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
