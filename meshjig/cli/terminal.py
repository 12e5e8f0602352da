"""What a person at a terminal sees of a run: its progress, and what to know of its result."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from meshjig.cli.streams import error_stream, say
from meshjig.runtime.messages import tell

__all__ = ["progress_bar", "tell_each", "tell_next_step", "tell_notes"]

FEW = 4  # names that a note gives


@contextmanager
def progress_bar(silent: bool) -> Iterator[Callable[[str, str], None]]:
    """Give a callback that shows the stage that runs, on standard error, when somebody watches."""
    stream = error_stream()
    if silent or stream is None or not stream.isatty():
        yield _remember
        return
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    def show(stage: str, event: str) -> None:
        _remember(stage, event)
        if event == "start":
            bar.update(task, description=stage)

    columns = SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn()
    with Progress(*columns, console=Console(file=stream), transient=True) as bar:
        task = bar.add_task("scan")
        yield show


def _remember(stage: str, event: str) -> None:
    """Keep the stage that runs for the sentence of a run that ends in it."""
    if event == "start":
        tell("stage", stage)


def tell_next_step(report: Mapping[str, Any], target: Path) -> None:
    """Say what to look at, and what to print."""
    options = report["options"]
    look = (
        f"meshjig view {shlex.quote(str(target))} shows it" if options["viewer"] else "preview.png shows it"
    )
    if report.get("plates"):
        what = "print the files in plates/, which plates.png shows"
    elif "3mf" in options["format"]:
        what = "print puzzle.3mf"
    elif {"stl", "ply"} & set(options["format"]):
        what = "print what is in pieces/"
    else:
        what = f"print puzzle.{options['format'][0]}"
    guide = "; guide.pdf tells how to put it together" if options["guide"] else ""
    say(f"next: {look}; {what}{guide}")


def tell_each(notes: Iterable[str]) -> None:
    """Say notes, a line each."""
    for note in notes:
        say(f"meshjig: note: {note}")


def tell_notes(report: Mapping[str, Any]) -> None:
    """Say what is no broken promise, but what a maker should know."""
    made, options = len(report["pieces"]), report["options"]
    if options["piece_size"] is None and abs(made - options["pieces"]) > 0.1 * options["pieces"]:
        say(f"meshjig: note: {options['pieces']} pieces were asked for, {made} fit this model")
    tell_each([*report["input"]["notes"], *report.get("notes", [])])
    limbs = report.get("cells", {}).get("thin_limbs", [])
    for limb in [limb for limb in limbs if limb["pieces"] > made]:
        where = ", ".join(f"{x:.0f}" for x in limb["at"])
        say(f"meshjig: note: the limb around ({where}) mm is thin: {limb['pieces']} pieces would suit it")
    necks = report["checks"]["thin_necks"]
    if necks:
        many = (
            f"{_count(necks, 'knob has a neck', 'knobs have necks')} thinner than {options['min_neck']:g} mm"
        )
        say(f"meshjig: note: {many}: {_some_of(report['names']['thin_necks'])}")
    bare = len(report.get("labels", {}).get("skipped", ()))
    if bare:
        say(f"meshjig: note: {bare} pieces have no room for their number (see labels in report.json)")
    swaps = report.get("unique", {}).get("interchangeable_pieces", 0)
    if swaps:
        say(f"meshjig: note: {swaps} pairs of pieces could still change places: try another --seed")
    for fact in report.get("plates", ()):
        if fact["plate"] is None:
            say(f"meshjig: note: {fact['why']}")


def _count(n: int, one: str, many: str) -> str:
    return f"{n} {one if n == 1 else many}"


def _some_of(names: Sequence[str]) -> str:
    """List names, the first of them where they are many."""
    return ", ".join(names[:FEW]) + (f" and {len(names) - FEW} more" if len(names) > FEW else "")
