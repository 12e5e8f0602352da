"""The command line: parse, call the library, print."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from meshjig.config import read_options
from meshjig.errors import OptionError
from meshjig.flags import takes_options
from meshjig.terminal import (
    BROKEN_PROMISE,
    INTERRUPTED,
    USAGE,
    as_lines,
    leave_interrupted,
    listen_for_interrupts,
    progress_bar,
    say,
    sentences,
    tell_broken,
    tell_notes,
)

__all__ = ["app", "main"]

app = typer.Typer(
    name="meshjig",
    help="Turn a triangle mesh into a printable 3D jigsaw puzzle of its surface.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

MeshPath = Annotated[str, typer.Argument(metavar="MESH", help="STL, OBJ, PLY, OFF, GLB or 3MF file")]
Config = Annotated[
    Path | None, typer.Option("--config", metavar="FILE.toml", help="read options from a TOML file")
]
AsJson = Annotated[bool, typer.Option("--json", help="print the result as JSON on standard output")]
Verbose = Annotated[bool, typer.Option("--verbose", "-v", help="say more")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="say nothing but errors")]


@app.callback(invoke_without_command=True)
def _root(
    context: typer.Context,
    show_version: Annotated[bool, typer.Option("--version", help="print the version")] = False,
) -> None:
    if show_version:
        from meshjig.report import meshjig_version

        print(meshjig_version())
        raise typer.Exit
    if context.invoked_subcommand is None:
        print(context.get_help())


@app.command()
@takes_options()
def make(
    mesh: MeshPath,
    flags: dict[str, Any],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="DIR", help="default: <mesh name>-jigsaw")
    ] = None,
    config: Config = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="only say what would be made, and write nothing")
    ] = False,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Make a puzzle: pieces, 3MF, preview, viewer, guide and report."""
    with sentences(verbose, quiet):
        options = read_options(config, flags)
        if dry_run:
            from meshjig.plan import plan_puzzle

            plan = plan_puzzle(mesh, options)
            print(json.dumps(plan, indent=2) if as_json else as_lines(plan))
            raise typer.Exit
        from meshjig.output.folder import check_target
        from meshjig.pipeline import make_puzzle

        target = output or Path(f"{Path(mesh).stem}-jigsaw")
        check_target(target)
        with progress_bar(quiet or verbose) as progress:
            puzzle = make_puzzle(mesh, progress=progress, options=options)
            progress("write", "start")
            puzzle.save(target)
        if as_json:
            print((target / "report.json").read_text(encoding="utf-8"))
        if not quiet:
            n = len(puzzle.pieces)
            say(f"{n} piece{'s' if n > 1 else ''} in {target}")
            tell_notes(puzzle.report)
    if not puzzle.report["ok"]:
        tell_broken(puzzle.report["failures"])
        raise typer.Exit(BROKEN_PROMISE)


@app.command()
@takes_options("size", "pieces", "faces", "fill_holes", "cavities", "resurface", "seed")
def info(
    mesh: MeshPath,
    flags: dict[str, Any],
    charts: Annotated[bool, typer.Option("--charts", help="also cut it into charts and judge them")] = False,
    method: Annotated[str | None, typer.Option(help="how charts are made, as make's --charts")] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="DIR", help="with --charts, draw them there")
    ] = None,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Say what a mesh is, and what would be done to it."""
    with sentences(verbose, quiet):
        options = read_options(None, flags | ({"charts": method} if method else {}))
        if charts or method or output:
            from meshjig.charting import describe_charts

            facts = describe_charts(mesh, options, output)
        else:
            from meshjig.scan import describe

            facts = describe(mesh, size=options.size, faces=options.faces, cavities=options.cavities)
        print(json.dumps(facts, indent=2) if as_json else as_lines(facts))


@app.command()
@takes_options("thickness", "clearance", "min_wall")
def check(
    paths: Annotated[list[Path], typer.Argument(metavar="DIR|FILES", help="a folder of pieces, or files")],
    flags: dict[str, Any],
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Judge finished pieces by their files, whatever made them.

    Of a report.json in the folder, what was asked for and who borders on whom is used; flags win.
    """
    with sentences(verbose, quiet):
        from meshjig.rejudge import rejudge

        result = rejudge(paths, flags)
        shown = result["checks"] | {key: result[key] for key in ("names", "core") if key in result}
        print(json.dumps(result, indent=2) if as_json else as_lines(shown))
    if not result["ok"]:
        tell_broken(result["failures"])
        raise typer.Exit(BROKEN_PROMISE)


@app.command()
@takes_options("process", "thickness", "clearance", "min_neck")
def coupon(
    flags: dict[str, Any],
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="where the coupon goes")
    ] = Path("meshjig-coupon"),
    config: Config = None,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Make a set of test knobs that tells which clearance your printer needs."""
    with sentences(verbose, quiet):
        from meshjig.coupon import save_coupon

        report = save_coupon(output, read_options(config, flags))
        if as_json:
            print((output / "report.json").read_text(encoding="utf-8"))
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
    with sentences(verbose, quiet):
        from meshjig.output.viewer import open_viewer

        page = open_viewer(directory)
        if as_json:
            print(json.dumps({"viewer": str(page)}))


@app.command()
def tiles(
    name: Annotated[str | None, typer.Argument(help="of a tiling; all are listed if none is given")] = None,
    svg: Annotated[Path | None, typer.Option("--svg", metavar="FILE", help="draw it there")] = None,
    seed: Annotated[int, typer.Option(min=0, help="seed of everything random")] = 0,
    as_json: AsJson = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """List the tilings, or draw one."""
    with sentences(verbose, quiet):
        from meshjig.tiling.registry import family_names, get_decor, get_family

        if name is None:
            known = dict(family_names())
            print(json.dumps(known, indent=2) if as_json else as_lines(known))
            return
        try:
            unit = get_family(name, seed)
        except OptionError as error:
            say(f"meshjig: {error}")
            raise typer.Exit(USAGE) from None
        if svg is not None:
            from meshjig.output.folder import write_text
            from meshjig.tiling.draw import draw_svg

            write_text(svg, draw_svg(unit, decor=get_decor(name)))
        facts = {"tiles": unit.n_tiles, "edges": len(unit.ends), "knobs": unit.template is not None}
        print(json.dumps(facts, indent=2) if as_json else as_lines(facts))


def main() -> None:
    """Run the command line."""
    try:
        listen_for_interrupts()
        app()
    except KeyboardInterrupt:
        say("meshjig: interrupted; nothing was written")
        leave_interrupted()
    except SystemExit as ending:
        if ending.code == INTERRUPTED:
            leave_interrupted()
        raise
