"""The journal of a batch: a line an event, on the disk before anything is said of it."""

from __future__ import annotations

import hashlib
import json
import os
from array import array
from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import IO, Any

import numpy as np

from meshjig.errors import OutputError, write_error
from meshjig.fleet.record import Record, record_of
from meshjig.output.folder.system import acquire

__all__ = ["Journal", "JournalIndex", "name_key"]

_SCAN, _AFTER = b'{"event": "scan", "name": ', b', "source": '  # between them stands the name


def name_key(name: str) -> int:
    """Give 64 bits that stand for a name."""
    return _key(json.dumps(name).encode("ascii"))


def _key(written: bytes) -> int:
    return int.from_bytes(hashlib.blake2b(written, digest_size=8).digest(), "little")


class JournalIndex:
    """Where in a journal the last word on each scan is: 16 bytes a scan, however many there are.

    Parameters
    ----------
    path : Path, of a journal; one that is not there is empty
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        keys, places = array("Q"), array("Q")
        self._file: IO[bytes] | None = None
        if path.is_file():
            self._file = path.open("rb")
            place = 0
            for line in self._file:
                if line.startswith(_SCAN) and _AFTER in line:
                    keys.append(_key(line[len(_SCAN) : line.index(_AFTER)]))
                    places.append(place)
                place += len(line)
        found = np.frombuffer(keys, np.uint64) if keys else np.zeros(0, np.uint64)
        order = np.argsort(found, kind="stable")
        self._keys = found[order]
        self._places = np.frombuffer(places, np.uint64)[order] if places else np.zeros(0, np.uint64)

    def find(self, name: str) -> tuple[Record, int] | None:
        """Give the last record of a scan and its place, or None."""
        last = int(np.searchsorted(self._keys, np.uint64(name_key(name)), side="right")) - 1
        if last < 0 or int(self._keys[last]) != name_key(name):
            return None
        place = int(self._places[last])
        record = self.read(place)
        return (record, place) if record is not None and record.name == name else None

    def read(self, place: int) -> Record | None:
        """Give the record at a place; None where none is."""
        if self._file is None:
            return None
        self._file.seek(place)
        try:
            return record_of(json.loads(self._file.readline()))
        except (ValueError, TypeError):
            return None

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()


class Journal:
    """The journal that a batch appends to; nobody else may do so at the same time.

    Parameters
    ----------
    path : Path
    others : sequence of Path
        Journals of other shards of the same batch, which may know of its scans.

    Raises
    ------
    OutputError
        It can't be written, or another batch is writing to it.
    """

    def __init__(self, path: Path, others: Sequence[Path] = ()) -> None:
        self.path = path
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            file = acquire(path)
            if file is None:
                raise OutputError(
                    f"another batch is writing to {path}", hint="wait until it has ended, or give --journal"
                )
            self._file = file
            self._end = _without_torn_line(file)
        except OSError as error:
            raise write_error(f"the journal {path}", error, "choose another place with --journal") from None
        self._own = JournalIndex(path)
        if self._own._file is None:
            self._own._file = path.open("rb")
        self._others = [JournalIndex(other) for other in others]

    def find(self, name: str) -> Record | None:
        """Give the last record of a scan, from this journal or from another shard's."""
        for index in (self._own, *self._others):
            found = index.find(name)
            if found is not None:
                return found[0]
        return None

    def keep(self, record: Record) -> int:
        """Write what became of a scan, unless the journal says so already; give the place of the line."""
        if record.kept:
            found = self._own.find(record.name)
            if found is not None and found[0].marks == record.marks and found[0].outcome == record.outcome:
                return found[1]
        return self.append("scan", record.as_dict())

    def append(self, event: str, facts: Mapping[str, Any]) -> int:
        """Append an event, and see that it is on the disk; give the place of its line.

        Raises
        ------
        OutputError, ResourceError
            It can't be written.
        """
        at = datetime.now(UTC).isoformat(timespec="milliseconds")
        line = json.dumps({"event": event, **facts, "at": at}).encode("ascii") + b"\n"
        place = self._end
        try:
            os.pwrite(self._file, line, place)
            os.fsync(self._file)
        except OSError as error:
            raise write_error(f"the journal {self.path}", error, "make room there") from None
        self._end += len(line)
        return place

    def records(self, places: Sequence[int]) -> Iterator[Record]:
        """Give records by their places."""
        for place in places:
            record = self._own.read(place)
            if record is not None:
                yield record

    def close(self) -> None:
        """Let others write to it."""
        for index in (self._own, *self._others):
            index.close()
        os.close(self._file)


def _without_torn_line(file: int) -> int:
    """Cut off what a client that was killed had begun to write; give where the journal ends."""
    end = os.fstat(file).st_size
    while end:
        begin = max(0, end - (1 << 16))
        last = os.pread(file, end - begin, begin).rfind(b"\n")
        if last >= 0:
            end = begin + last + 1
            break
        end = begin
    os.ftruncate(file, end)
    return end
