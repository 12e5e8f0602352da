"""The only right to write to a folder, and what is needed to clear up after a run that was killed."""

from __future__ import annotations

import hashlib
import json
import logging
import os
import re
import shutil
import threading
import uuid
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from meshjig.errors import OutputError
from meshjig.output.folder.manifest import discard, read_manifest, stranger
from meshjig.output.folder.system import acquire, exchange, release
from meshjig.runtime.messages import tell
from meshjig.runtime.signals import hold_signals

__all__ = ["Claim", "claimed", "settle"]

_OURS = re.compile(r"\.meshjig-[0-9a-f]{12}-[0-9a-f]{12}(-old)?")
_log = logging.getLogger(__name__)


class Claim:
    """The right to put a folder in the place of a target.

    A hidden file beside the target is its lock, and the journal of what was begun there: the new folder
    (``new``, and its ``inode`` once it is made), where the old one was moved (``old``), parents that were
    made for the target (``parent``). Whoever takes the lock after its owner was killed clears up by it.

    Parameters
    ----------
    target : Path, without links

    Raises
    ------
    OutputError
        Another run holds it.
    OSError
        Nothing can be written beside the target.
    """

    def __init__(self, target: Path) -> None:
        self.target, self.thread = target, threading.get_ident()
        self._lock = _lock_of(target)
        tell("target", str(target))
        made = _make_parents(target.parent)
        try:
            file = acquire(self._lock)
        except BaseException:
            _remove_empty(made)
            raise
        if file is None:
            raise OutputError(
                f"another run of meshjig is writing to {target}",
                hint="wait until it has ended, or choose another folder with -o",
            )
        self._file = file
        try:
            self.in_place = self._recover()  # what a run that was killed had put there
            self._note(*(["parent", str(parent)] for parent in [*self._parents, *made]))
        except BaseException:
            release(self._lock, self._file)
            _remove_empty(made)
            raise

    def new_folder(self) -> Path:
        """Make a hidden folder beside the target."""
        scratch = self._lock.with_name(f"{self._lock.stem}-{uuid.uuid4().hex[:12]}")
        self._note(["new", scratch.name])
        scratch.mkdir()
        self._note(["inode", scratch.lstat().st_ino])
        return scratch

    def put_in_place(self, scratch: Path) -> None:
        """Put a new folder in the target's place, and remove the old one.

        Raises
        ------
        OutputError
            The old folder holds something that meshjig did not write; it is back in its place.
        OSError
            It can't be done; the target is as it was.
        """
        target = self.target
        if not target.exists() or not any(target.iterdir()):
            if target.exists():
                scratch.chmod(target.stat().st_mode)
                if os.name == "nt":  # where a rename replaces no folder
                    target.rmdir()
            os.rename(scratch, target)
            tell("written", str(target))
            return
        scratch.chmod(target.stat().st_mode)
        old = scratch
        if not exchange(scratch, target):
            old = scratch.with_name(scratch.name + "-old")
            self._note(["old", old.name])
            os.rename(target, old)
            try:
                os.rename(scratch, target)
            except BaseException:
                os.rename(old, target)
                raise
        found = stranger(old, read_manifest(old))
        if found is not None:  # it came since the target was looked at
            _change_back(target, old, scratch)
            raise OutputError(
                f"{target / found[0].relative_to(old)} {found[1]}, so the folder is left alone",
                hint="choose another with -o",
            )
        tell("written", str(target))
        self._discard(old)

    def clear(self) -> None:
        """Remove what was begun and is not in place."""
        self._recover()
        self._note(*(["parent", str(parent)] for parent in self._parents))

    def release(self) -> None:
        """Clear up, and give the right back."""
        try:
            self._recover()
        finally:
            release(self._lock, self._file)
            _remove_empty(self._parents)

    def _recover(self) -> bool:
        """Finish, or take back, what the journal says was begun; tell whether the new folder is in place."""
        told: dict[str, list[str]] = {"new": [], "inode": [], "old": [], "parent": []}
        os.lseek(self._file, 0, os.SEEK_SET)
        for line in os.read(self._file, 1 << 20).splitlines():
            with suppress(ValueError, KeyError, TypeError):
                word, value = json.loads(line)
                told[word].append(str(value))
        inode = told["inode"][-1] if told["inode"] else None
        for old in map(self._named, told["old"]):
            if old is not None and old.exists():
                if self.target.exists():
                    self._discard(old)
                else:
                    os.rename(old, self.target)
        for scratch in map(self._named, told["new"]):
            if scratch is not None and scratch.exists():
                if inode in (None, str(scratch.lstat().st_ino)):
                    shutil.rmtree(scratch, ignore_errors=True)
                else:
                    self._discard(scratch)
        os.ftruncate(self._file, 0)
        self._parents = [Path(parent) for parent in told["parent"]]
        return self.target.exists() and inode == str(self.target.lstat().st_ino)

    def _discard(self, old: Path) -> None:
        """Remove an old folder; should somebody have put something there since, keep that in sight."""
        try:
            discard(old)
        except OutputError:
            kept = self.target.with_name(f"{self.target.name[:200]}-old-{uuid.uuid4().hex[:6]}")
            os.rename(old, kept)
            _log.warning("meshjig: note: %s holds what meshjig did not write, and was in the way", kept)

    def _note(self, *lines: Sequence[str | int]) -> None:
        os.lseek(self._file, 0, os.SEEK_END)
        os.write(self._file, b"".join(json.dumps(line).encode("ascii") + b"\n" for line in lines))

    def _named(self, name: str) -> Path | None:
        return self._lock.with_name(name) if _OURS.fullmatch(name) else None


_held: dict[Path, Claim] = {}


@contextmanager
def claimed(target: Path) -> Iterator[Claim]:
    """Hold the only right to write to a folder; a thread that holds it may take it once more."""
    held = _held.get(target)
    if held is not None and held.thread == threading.get_ident():
        yield held
        return
    claim = Claim(target)
    _held[target] = claim
    try:
        yield claim
    finally:
        with hold_signals():
            del _held[target]
            claim.release()


def settle(target: Path) -> bool:
    """Clear up after a run that was killed; tell whether it had put its folder in the target's place."""
    if not _lock_of(target).exists():
        return False
    claim = Claim(target)
    claim.release()
    return claim.in_place


def _lock_of(target: Path) -> Path:
    """Name the lock of a target; long names have room for nothing added to them."""
    digest = hashlib.sha256(os.fsencode(target.name)).hexdigest()[:12]
    return target.with_name(f".meshjig-{digest}.lock")


def _change_back(target: Path, old: Path, scratch: Path) -> None:
    if old == scratch:
        exchange(scratch, target)
    else:
        os.rename(target, scratch)
        os.rename(old, target)


def _make_parents(folder: Path) -> list[Path]:
    """Make a folder and what is missing above it; give what was made, outermost first."""
    if folder.exists():
        return []
    made = _make_parents(folder.parent)
    tell("parent", str(folder))
    try:
        folder.mkdir()
    except BaseException:
        _remove_empty(made)
        raise
    return [*made, folder]


def _remove_empty(folders: list[Path]) -> None:
    for folder in reversed(folders):
        with suppress(OSError):
            folder.rmdir()
