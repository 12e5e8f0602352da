"""What became of a batch so far, counted."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from meshjig.fleet.record import BROKEN, FAILED, Record

__all__ = ["Tally"]


@dataclass
class Tally:
    """Counts of what became of scans."""

    scans: int = 0
    made: int = 0  # with every promise kept
    broken: int = 0  # made, with a promise broken
    failed: int = 0
    kept: int = 0  # of all these: there already, as they were written, or known to fail
    retried: int = 0  # attempts that failed by the machine and were made again
    kinds: Counter[str] = field(default_factory=Counter)  # of failures

    def add(self, record: Record) -> None:
        """Count one."""
        self.scans += 1
        self.kept += record.kept
        if record.outcome == FAILED:
            self.failed += 1
            self.kinds[record.kind] += 1
        elif record.outcome == BROKEN:
            self.broken += 1
        else:
            self.made += 1

    @property
    def exit(self) -> int:
        """The exit code: 0 all good, 1 some failed, 3 none failed, but promises are broken."""
        return 1 if self.failed else 3 if self.broken else 0

    def as_dict(self) -> dict[str, object]:
        """Give what --json prints."""
        return {
            "ok": self.exit == 0,
            "scans": self.scans,
            "made": self.made,
            "broken": self.broken,
            "failed": self.failed,
            "kept": self.kept,
            "retried": self.retried,
            "failures": dict(sorted(self.kinds.items())),
            "exit": self.exit,
        }

    def __str__(self) -> str:
        """Say it in a line."""
        said = [f"{self.scans} scan{'s' * (self.scans != 1)}", f"{self.made} made"]
        if self.broken:
            said.append(f"{self.broken} made with broken promises")
        if self.failed:
            kinds = ", ".join(f"{kind} {n}" for kind, n in self.kinds.most_common())
            said.append(f"{self.failed} failed ({kinds})")
        if self.kept:
            said.append(f"{self.kept} of them known from before")
        return ", ".join(said)
