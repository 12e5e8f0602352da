"""What is written at the end of a batch: the table, and the page."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path

from meshjig.errors import write_error
from meshjig.fleet.page import MOST_ROWS, write_page
from meshjig.fleet.places import below, is_url, push_file
from meshjig.fleet.record import BROKEN, FAILED, MADE, Record
from meshjig.fleet.summary import write_csv, write_parquet
from meshjig.fleet.tally import Tally

__all__ = ["write_results"]

_ORDER = (FAILED, BROKEN, MADE)


def write_results(
    out: str,
    named: Callable[[str], str],
    records: Callable[[], Iterator[Record]],
    tally: Tally,
) -> None:
    """Write summary.csv, summary.parquet where pyarrow is there, and index.html.

    Parameters
    ----------
    out : str, the folder of the batch
    named : callable, gives what a file is called by this share of the batch
    records : callable, gives the records from their beginning, in the order of the list
    tally : Tally

    Raises
    ------
    OutputError, ResourceError
        They can't be written.
    """
    with tempfile.TemporaryDirectory(dir=None if is_url(out) else out, prefix=".meshjig-batch-") as name:
        folder = Path(name)
        try:
            write_csv(folder / "summary.csv", records())
            write_parquet(folder / "summary.parquet", records())
            write_page(folder / "index.html", _failures_first(records), tally, named("summary.csv"))
            for path in sorted(folder.iterdir()):
                place = below(out, named(path.name))
                if is_url(out):
                    push_file(path, place)
                else:
                    os.replace(path, place)
        except OSError as error:
            raise write_error(f"the summary in {out}", error, "make room there") from None


def _failures_first(records: Callable[[], Iterator[Record]]) -> Iterator[Record]:
    """Give as many as a page shows."""
    ordered = (record for outcome in _ORDER for record in records() if record.outcome == outcome)
    return islice(ordered, MOST_ROWS)
