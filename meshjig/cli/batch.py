"""The command that makes puzzles of many scans."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any, cast

import typer

from meshjig.cli.batch_progress import batch_progress
from meshjig.cli.config import read_given
from meshjig.cli.flags import AsJson, Config, Flags, Quiet, Verbose
from meshjig.cli.streams import emit, say, set_verbosity
from meshjig.errors import OptionError
from meshjig.options import OptionKeywords
from meshjig.runtime.cores import cores
from meshjig.runtime.messages import tell

__all__ = ["batch"]


def batch(
    flags: Flags,
    inputs: Annotated[
        list[str] | None, typer.Argument(metavar="INPUTS", help="files, folders, patterns and URLs")
    ] = None,
    output: Annotated[
        str | None, typer.Option("--output", "-o", metavar="DIR", help="a folder for all, or its URL")
    ] = None,
    listed: Annotated[
        Path | None,
        typer.Option(
            "--from", metavar="LIST", help="a .txt of scans, or a .csv or .parquet with options too"
        ),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            min=1, metavar="N", help="scans at a time on this machine (default: as it has room for)"
        ),
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="tcp://HOST:PORT", help="of a Dask cluster that runs already")
    ] = None,
    scheduler_file: Annotated[
        Path | None, typer.Option(metavar="FILE", help="the same, by the file that its scheduler wrote")
    ] = None,
    timeout: Annotated[float, typer.Option(metavar="S", help="seconds that a scan may take")] = 900.0,
    retries: Annotated[
        int, typer.Option(metavar="N", help="of a scan that failed by a signal, a limit or a lost worker")
    ] = 1,
    window: Annotated[int, typer.Option(metavar="N", help="scans that Dask knows of at a time")] = 1000,
    shard: Annotated[
        str | None, typer.Option(metavar="I/N", help="only this share, one after another, without Dask")
    ] = None,
    journal: Annotated[
        Path | None, typer.Option(metavar="FILE", help="where it is written down (default: in DIR)")
    ] = None,
    config: Config = None,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Make puzzles of many scans, each in a process of its own; begun again, it does what is missing.

    Exit codes: 0 all good; 1 some failed; 3 none failed, but promises are broken; others as for make.
    """
    set_verbosity(verbose, quiet)
    given = read_given(config, flags)
    if not output or output.startswith("--"):
        raise OptionError("batch needs a folder for its puzzles", hint="give one with -o DIR")
    from meshjig.fleet.batch import Batch
    from meshjig.fleet.settings import BatchSettings

    if shard is not None and (workers or scheduler or scheduler_file):
        raise OptionError("--shard works one after another, without a cluster", hint="leave out one of them")
    share = _shard(shard)
    settings = BatchSettings(listed, timeout, retries, window, share, journal)
    run = Batch(inputs or [], output, None, settings, cast(OptionKeywords, given))
    tell("lasting", f"what is done is in {output}, and the same command does the rest")
    with _cluster(shard, workers or _room(run.terms.memory), scheduler, scheduler_file) as client:
        run.client = client
        with batch_progress(run, quiet, verbose) as show:
            for record in run:
                show(record)
    if not quiet:
        say(f"{run.tally}; see {output.rstrip('/')}/{share.name('index.html')}")
    if as_json:
        emit(json.dumps(run.tally.as_dict(), indent=2))
    if run.tally.exit:
        raise typer.Exit(run.tally.exit)


@contextmanager
def _cluster(
    shard: str | None, workers: int, scheduler: str | None, scheduler_file: Path | None
) -> Iterator[Any]:
    """Give the client of the cluster that was asked for; none for a share of a batch."""
    if shard is not None:
        yield None
        return
    if scheduler and scheduler_file:
        raise OptionError("--scheduler and --scheduler-file name two clusters", hint="give one of them")
    from meshjig.fleet.cluster import connected, local_cluster

    there = scheduler or scheduler_file
    with connected(scheduler, scheduler_file) if there else local_cluster(workers) as client:
        if there and not client.nthreads():
            say(f"meshjig: note: the scheduler at {there} has no workers yet; they may come")
        yield client


def _room(memory: float) -> int:
    """Give how many scans this machine has cores and memory for at a time."""
    import psutil

    return max(1, min(cores(), int(psutil.virtual_memory().total / (memory * 1e9))))


def _shard(text: str | None) -> Any:
    from meshjig.fleet.settings import Shard

    if text is None:
        return Shard()
    number, slash, of = text.partition("/")
    if not (slash and number.isdecimal() and of.isdecimal()):
        raise OptionError(f"--shard: {text!r} is no share", hint="write 1/8 for the first of eight")
    return Shard(int(number), int(of))
