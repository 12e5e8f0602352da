"""What became of one scan of a batch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, NamedTuple

__all__ = ["BROKEN", "FAILED", "MADE", "Marks", "Record", "failed_by_machine", "record_of"]

MADE, BROKEN, FAILED = "made", "broken", "failed"  # outcomes; broken: made, but promises are broken
_FINAL = {0, 1, 2, 3, 4, 70}  # exit codes that the same scan would end with again
LOST = "lost"  # kinds of failure that meshjig make does not know, by the machine
TIME = "time-out"


class Marks(NamedTuple):
    """What a result depends on: where all three are equal, it is the same."""

    input: str  # SHA-256 of the scan, and of the files that it names
    options: str  # SHA-256 of all options that change the result
    version: str  # of meshjig


@dataclass(frozen=True)
class Record:
    """What became of one scan."""

    name: str  # of its folder, below that of the batch; parts are separated by slashes
    source: str  # path or URL
    outcome: str  # made, broken or failed
    kind: str = ""  # of failure: as in the JSON of meshjig make, or time-out, or lost with its worker
    message: str = ""  # what is wrong
    hint: str = ""  # what to do about it
    stage: str | None = None  # in which it ended
    exit: int | None = None  # exit code of meshjig make; None where it was ended
    signal: int | None = None  # that ended it
    seconds: float = 0.0  # from its start to its end
    peak_mb: float = 0.0  # the most memory that its processes held together
    pieces: int | None = None
    size_mm: tuple[float, ...] = ()  # extents of the model
    faces: int | None = None  # of the scan as it came
    broken: tuple[str, ...] = ()  # promises that are broken
    shows: tuple[str, ...] = ()  # of viewer.html and guide.pdf, those that are there
    attempts: int = 1
    host: str = ""  # the machine that did it
    kept: bool = False  # it was there already, and is as it was written
    marks: Marks = field(default_factory=lambda: Marks("", "", ""))

    @property
    def sentence(self) -> str:
        """What a person is told of a failure; empty where there is none."""
        return f"{self.message}: {self.hint}" if self.hint else self.message

    def as_dict(self) -> dict[str, object]:
        """Give what a line of the journal holds of it."""
        return asdict(self) | {"marks": self.marks._asdict()}

    def again(self, attempts: int) -> Record:
        """Give the same after so many attempts."""
        return replace(self, attempts=attempts)


def failed_by_machine(record: Record) -> bool:
    """Tell whether a scan failed for a reason that may be gone when it is tried again."""
    return record.outcome == FAILED and record.exit not in _FINAL


def record_of(line: Mapping[str, Any]) -> Record | None:
    """Read a record from a line of the journal; None where it holds none, or one of another version's."""
    known = {one.name for one in fields(Record)}
    try:
        given = {key: value for key, value in line.items() if key in known}
        given["marks"] = Marks(**given["marks"])
        given |= {key: tuple(given[key]) for key in ("size_mm", "broken", "shows")}
        return Record(**given)
    except (KeyError, TypeError):
        return None
