"""What a person at a terminal sees of a batch while it goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from meshjig.cli.streams import error_stream, say

if TYPE_CHECKING:
    from meshjig.fleet.batch import Batch
    from meshjig.fleet.record import Record

__all__ = ["batch_progress"]


@contextmanager
def batch_progress(run: Batch, quiet: bool, verbose: bool) -> Iterator[Callable[[Record], None]]:
    """Give a callback for each record: it moves a bar where somebody watches, else it names what failed."""
    stream = error_stream()
    if quiet or stream is None or not stream.isatty():
        yield (lambda record: None) if quiet else _name_failure
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[failures]}"),
    )
    with Progress(*columns, console=Console(file=stream), transient=True) as bar:
        task = bar.add_task("", total=run.total(), rate="", failures="")

        def show(record: Record) -> None:
            if verbose:
                bar.console.print(_line(record), markup=False, highlight=False)
            speed = bar.tasks[0].finished_speed or bar.tasks[0].speed or 0.0
            failures = ", ".join(f"{kind} {n}" for kind, n in run.tally.kinds.most_common())
            bar.update(
                task,
                advance=1,
                rate=f"{60 * speed:.3g} a minute",
                failures=f"failed: {failures}" if failures else "",
            )

        yield show


def _name_failure(record: Record) -> None:
    if record.sentence:
        say(f"meshjig: {_line(record)}")


def _line(record: Record) -> str:
    return f"{record.name}: {record.sentence or record.outcome}"
