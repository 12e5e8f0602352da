"""The command line: parse, call the library, print."""

from __future__ import annotations

import json
import os
import signal
from pathlib import Path
from typing import Annotated

import typer

from meshjig.cli.batch import batch
from meshjig.cli.config import read_options
from meshjig.cli.endings import BROKEN_PROMISE, EPILOG, Ending, broken_promises
from meshjig.cli.flags import AsJson, Config, Flags, Quiet, Verbose, takes_options
from meshjig.cli.lines import as_lines
from meshjig.cli.streams import emit, say, set_verbosity
from meshjig.cli.terminal import progress_bar, tell_each, tell_next_step, tell_notes
from meshjig.errors import OptionError
from meshjig.options import Options
from meshjig.runtime.bounded import ReadAhead
from meshjig.runtime.cores import cores, thread_limits

__all__ = ["app"]

app = typer.Typer(
    name="meshjig",
    help="Turn a triangle mesh into a printable 3D jigsaw puzzle of its surface.",
    epilog=EPILOG,
    context_settings={"help_option_names": ["--help", "-h"]},
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

MeshPath = Annotated[str, typer.Argument(metavar="MESH", help="STL, OBJ, PLY, OFF, glTF, GLB or 3MF file")]


@app.callback(invoke_without_command=True)
def _root(
    context: typer.Context,
    show_version: Annotated[bool, typer.Option("--version", help="print the version")] = False,
) -> None:
    if show_version:
        from meshjig.runtime.version import meshjig_version

        emit(meshjig_version())
        raise typer.Exit
    if context.invoked_subcommand is None:
        emit(context.get_help())


@app.command()
@takes_options()
def make(
    mesh: MeshPath,
    flags: Flags,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="DIR", help="folder of the puzzle (default: <mesh name>-jigsaw)"
        ),
    ] = None,
    config: Config = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="only say what would be made, and write nothing")
    ] = False,
    debug_dir: Annotated[
        Path | None, typer.Option("--debug-dir", metavar="DIR", help="also draw there what each stage makes")
    ] = None,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Make a puzzle: pieces, 3MF, preview, viewer, guide and report."""
    set_verbosity(verbose, quiet)
    options = read_options(config, flags)
    _refuse_no_name(mesh)
    _limit(options)
    if dry_run:
        from meshjig.pipeline.plan import plan_puzzle

        plan = plan_puzzle(mesh, options)
        notes = plan["notes"] if as_json else plan.pop("notes")
        emit(json.dumps(plan, indent=2) if as_json else as_lines(plan))
        if not quiet:
            tell_each(notes)
        raise typer.Exit
    from meshjig.output.folder import reserve_folder
    from meshjig.output.report import report_file

    target = Path(f"{Path(mesh).stem}-jigsaw") if output is None else _folder(output)
    inputs: list[str | Path] = [mesh, *([config] if config else [])]
    with reserve_folder(target, inputs=inputs), progress_bar(quiet or verbose) as progress:
        scan = ReadAhead(mesh)
        from meshjig.pipeline.make import make_puzzle

        puzzle = make_puzzle(scan, progress=progress, options=options, debug_dir=debug_dir)
        progress("write", "start")
        puzzle.save(target)
    if not quiet:
        n = len(puzzle.pieces)
        say(f"{n} piece{'s' if n > 1 else ''} in {target}")
        tell_notes(puzzle.report)
        tell_next_step(puzzle.report, target)
    _answer(json.loads(report_file(target / "report.json")) if as_json else {}, puzzle.report["failures"])


@app.command()
@takes_options(
    *("size", "unit", "keep", "pieces", "faces", "fill_holes", "memory", "cavities", "resurface", "seed"),
    *("process", "thickness", "min_wall"),
)
def info(
    mesh: MeshPath,
    flags: Flags,
    charts: Annotated[bool, typer.Option("--charts", help="also cut it into charts and judge them")] = False,
    method: Annotated[
        str | None, typer.Option(metavar="NAME", help="how charts are made, as make's --charts")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="DIR", help="with --charts, draw them there")
    ] = None,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Say what a mesh is, and what would be done to it."""
    set_verbosity(verbose, quiet)
    flags |= {} if method is None else {"charts": method}
    options = read_options(None, flags, spelt={"charts": "method"})
    _refuse_no_name(mesh)
    _limit(options)
    if charts or method or output:
        from meshjig.pipeline.prepare import describe_charts

        facts = describe_charts(mesh, options, output and _folder(output))
    else:
        scan = ReadAhead(mesh)
        from meshjig.pipeline.prepare import describe_model

        facts = describe_model(scan, options)
    emit(json.dumps(facts, indent=2) if as_json else as_lines(facts))


@app.command()
@takes_options("thickness", "clearance", "min_wall")
def check(
    paths: Annotated[list[Path], typer.Argument(metavar="DIR|FILES", help="a folder of pieces, or files")],
    flags: Flags,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Judge finished pieces by their files, whatever made them.

    Of a report.json in the folder, what was asked for and who borders on whom is used; flags win.
    """
    set_verbosity(verbose, quiet)
    from meshjig.pipeline.check_folder import check_folder

    options = read_options(None, flags)
    result = check_folder(paths, {name: getattr(options, name) for name in flags})
    if not as_json:
        shown = result["checks"] | {key: result[key] for key in ("names", "core") if key in result}
        emit(as_lines(shown, missing="not measured"))
    _answer(result if as_json else {}, result["failures"])


@app.command()
@takes_options("process", "thickness", "clearance", "min_neck")
def coupon(
    flags: Flags,
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="where the coupon goes")
    ] = Path("meshjig-coupon"),
    config: Config = None,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Make test knobs that tell which clearance your printer needs."""
    set_verbosity(verbose, quiet)
    from meshjig.pipeline.coupon import save_coupon

    report = save_coupon(_folder(output), read_options(config, flags))
    if as_json:
        emit((output / "report.json").read_text(encoding="utf-8"))
    elif not quiet:
        say(f"{len(report['pieces'])} tiles in {output}")
        say(report["how_to"])


@app.command()
def view(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="a folder that meshjig made")],
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Open a puzzle's viewer in the browser."""
    set_verbosity(verbose, quiet, libraries=True)  # a browser may have to say something
    from meshjig.output.viewer.page import open_viewer

    if hasattr(signal, "pthread_sigmask"):  # a browser must hear Ctrl-C, which is kept from a run
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    page = open_viewer(directory)
    if as_json:
        emit(json.dumps({"viewer": str(page)}))


@app.command()
@takes_options("seed")
def tiles(
    flags: Flags,
    name: Annotated[str | None, typer.Argument(help="of a tiling; all are listed if none is given")] = None,
    svg: Annotated[Path | None, typer.Option("--svg", metavar="FILE", help="draw it there")] = None,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """List the tilings, or draw one."""
    set_verbosity(verbose, quiet)
    from meshjig.tiling.registry import family_names, get_decor, get_family

    seed = read_options(None, flags).seed
    if name is None:
        known = dict(family_names())
        emit(json.dumps(known, indent=2) if as_json else as_lines(known))
        return
    unit = get_family(name, seed)
    if svg is not None:
        from meshjig.output.folder.text_file import write_svg_file
        from meshjig.tiling.draw import draw_svg

        write_svg_file(svg, draw_svg(unit, decor=get_decor(name)))
    facts = {"tiles": unit.n_tiles, "edges": len(unit.ends), "knobs": unit.template is not None}
    emit(json.dumps(facts, indent=2) if as_json else as_lines(facts))


app.command()(takes_options()(batch))


def _limit(options: Options) -> None:
    """Keep the run within the limits of cores and of memory that were given, if any was."""
    if options.cores is not None:
        os.environ |= thread_limits(options.cores)  # before the libraries that read it are loaded
    cores()  # refuses what the environment says, if that is no number
    if options.memory is not None:
        from meshjig.runtime.memory import watch_memory

        watch_memory(options.memory)


def _refuse_no_name(mesh: str) -> None:
    if not mesh:
        raise OptionError("the name of the mesh is empty", hint="give that of a file")


def _folder(given: Path, flag: str = "--output") -> Path:
    """Refuse an empty name, as an unset variable of a script gives it, and a flag in its place."""
    if str(given) == ".":
        raise OptionError(f"{flag}: the name is empty", hint="give that of a folder")
    if str(given).startswith("--"):
        raise OptionError(f"{flag} needs a folder, and {given} follows", hint=f"write ./{given} if it is one")
    return given


def _answer(answer: dict[str, object], failures: dict[str, list[str]]) -> None:
    """Print an answer as JSON, if there is one, name the promises that are broken, and end accordingly."""
    broken = broken_promises(failures)
    if broken:
        ending = Ending("promise", "; ".join(broken), "", "check", BROKEN_PROMISE)
        answer = answer and answer | ending.as_dict()
    if answer:
        emit(json.dumps(answer, indent=2, ensure_ascii=False))
    for sentence in broken:
        say(f"meshjig: {sentence}")
    if broken:
        raise typer.Exit(BROKEN_PROMISE)
