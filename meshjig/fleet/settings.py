"""How a batch is worked through, and which share of it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from meshjig.errors import OptionError

__all__ = ["BatchSettings", "Shard"]


@dataclass(frozen=True)
class Shard:
    """A share of a batch: every n-th scan."""

    number: int = 1  # from 1
    of: int = 1

    def __post_init__(self) -> None:
        if not 1 <= self.number <= self.of:
            raise OptionError(f"--shard: {self.number}/{self.of} is no share", hint="give 1/8 to 8/8")

    def name(self, name: str) -> str:
        """Give the name of a file that each share has for itself."""
        stem, dot, suffix = name.partition(".")
        return name if self.of == 1 else f"{stem}-{self.number}-of-{self.of}{dot}{suffix}"


@dataclass(frozen=True)
class BatchSettings:
    """How a batch is worked through; what is made is said by the options."""

    listed: Path | None = None  # a list of scans, .txt, .csv or .parquet
    timeout: float = 900.0  # s that a scan may take
    retries: int = 1  # of what fails by the machine: a signal, a lost worker, a limit of time or memory
    window: int = 1000  # scans that the scheduler knows of at a time
    shard: Shard = Shard()
    journal: Path | None = None  # in the folder of the batch if not given

    def __post_init__(self) -> None:
        for name, least in (("timeout", 0.1), ("retries", 0), ("window", 1)):
            if not getattr(self, name) >= least:
                raise OptionError(f"--{name}: {getattr(self, name):g} is too small", hint=f"give {least:g}")
