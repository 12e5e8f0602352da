"""What a person at a terminal sees: sentences, progress, and a clean end."""

from __future__ import annotations

import logging
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any

import typer

from meshjig.errors import MeshjigError, OutputError, ResourceError
from meshjig.runtime.messages import folders_written

__all__ = [
    "BROKEN_PROMISE",
    "FAILED",
    "INTERRUPTED",
    "USAGE",
    "as_lines",
    "emit",
    "outcome",
    "progress_bar",
    "say",
    "sentences",
    "tell_broken",
    "tell_notes",
]

FAILED, USAGE, BROKEN_PROMISE, RESOURCES, INTERRUPTED = 1, 2, 3, 5, 130


def say(sentence: str) -> None:
    """Print to standard error, if somebody listens there."""
    with suppress(OSError, ValueError, AttributeError):  # full or closed; it is no reason to end
        print(sentence, file=sys.stderr, flush=True)


def emit(text: str) -> None:
    """Print a result to standard output.

    Raises
    ------
    OutputError
        It can't be written. A reader that has gone away is none of our business.
    """
    try:
        print(text, flush=True)
    except BrokenPipeError:
        _close_output()
    except (OSError, ValueError) as error:
        _close_output()
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise OutputError(f"standard output can't be written ({reason}); {outcome()}") from None


def outcome() -> str:
    """Say what this run has written, after a sentence on why it ends."""
    folders = folders_written()
    return f"{', '.join(folders)} is whole" if folders else "nothing was written"


@contextmanager
def sentences(verbose: bool, quiet: bool) -> Iterator[None]:
    """Turn whatever goes wrong into one sentence on standard error, and an exit code."""
    level = logging.DEBUG if verbose else logging.ERROR if quiet else logging.WARNING
    logging.basicConfig(level=logging.WARNING, stream=sys.stderr, format="%(message)s")
    logging.getLogger("meshjig").setLevel(level)
    logging.getLogger("meshjig.told").setLevel(logging.ERROR if quiet else logging.INFO)
    try:
        yield
    except MeshjigError as error:
        say(f"meshjig: {error}")
        raise typer.Exit(RESOURCES if isinstance(error, ResourceError) else FAILED) from None
    except KeyboardInterrupt:
        say(f"meshjig: interrupted; {outcome()}")
        raise typer.Exit(INTERRUPTED) from None
    except MemoryError:
        say("meshjig: not enough memory: use fewer faces (--faces)")
        raise typer.Exit(RESOURCES) from None
    except typer.Exit:
        raise
    except Exception as error:
        if verbose:
            logging.getLogger("meshjig").exception("unexpected failure")
        reason = f"{type(error).__name__}: {error}".splitlines()[0]
        say(f"meshjig: unexpected failure ({reason}); {outcome()}, and this is a bug: -v shows where")
        raise typer.Exit(FAILED) from None


@contextmanager
def progress_bar(silent: bool) -> Iterator[Callable[[str, str], None]]:
    """Give a callback that shows the stage that runs, on standard error, when somebody watches."""
    if silent or sys.stderr is None or not sys.stderr.isatty():
        yield lambda stage, event: None
        return
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    def show(stage: str, event: str) -> None:
        if event == "start":
            bar.update(task, description=stage)

    columns = SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn()
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("scan")
        yield show


def tell_broken(failures: dict[str, list[str]]) -> None:
    """Name every broken promise and the pieces that break it."""
    for promise, names in failures.items():
        shown = ", ".join(names[:8]) + (f" and {len(names) - 8} more" if len(names) > 8 else "")
        say(f"meshjig: broken promise: {promise}" + (f" ({shown})" if names else ""))


def tell_notes(report: Mapping[str, Any]) -> None:
    """Say what is no broken promise, but what a maker should know."""
    made, options = len(report["pieces"]), report["options"]
    if options["piece_size"] is None and abs(made - options["pieces"]) > 0.1 * options["pieces"]:
        say(f"meshjig: note: {options['pieces']} pieces were asked for, {made} fit this model")
    for note in report["input"]["notes"]:
        say(f"meshjig: note: {note}")
    if report["exempt"]:
        n = len({name for names in report["exempt"].values() for name in names})
        say(f"meshjig: note: the mesh crosses itself, and so do {n} pieces: --resurface rebuilds its surface")
    limbs = report.get("cells", {}).get("thin_limbs", [])
    for limb in [limb for limb in limbs if limb["pieces"] > made]:
        where = ", ".join(f"{x:.0f}" for x in limb["at"])
        say(f"meshjig: note: the limb around ({where}) mm is thin: {limb['pieces']} pieces would suit it")
    necks, walls = report["checks"]["thin_necks"], report["checks"]["thin_walls"]
    if necks:
        say(f"meshjig: note: {necks} knobs have necks thinner than {options['min_neck']:g} mm")
    if walls:
        say(f"meshjig: note: {walls} pieces have places thinner than {options['min_wall']:g} mm")
    bare = len(report.get("labels", {}).get("skipped", ()))
    if bare:
        say(f"meshjig: note: {bare} pieces have no room for their number (see labels in report.json)")
    swaps = report.get("unique", {}).get("interchangeable_pieces", 0)
    if swaps:
        say(f"meshjig: note: {swaps} pairs of pieces could still change places: try another --seed")
    for fact in report.get("plates", ()):
        if fact["plate"] is None:
            say(f"meshjig: note: {fact['why']}")


def as_lines(facts: Mapping[str, Any], indent: str = "") -> str:
    """Write facts for people, a line each."""
    lines = []
    for key, value in facts.items():
        if isinstance(value, Mapping):
            lines.append(f"{indent}{key}:")
            lines.append(as_lines(value, indent + "  "))
        else:
            shown = f"{value:.4g}" if isinstance(value, float) else "not known" if value is None else value
            lines.append(f"{indent}{key}: {shown}")
    return "\n".join(lines)


def _close_output() -> None:
    """Let what is still to be printed go nowhere."""
    with suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
