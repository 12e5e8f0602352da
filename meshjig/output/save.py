"""A whole puzzle in a folder: pieces, 3MF and the like, preview, viewer, guide, curves, report."""

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats
from meshjig.mesh.mesh import concatenate
from meshjig.output.files.curve_files import Curves, write_dxf, write_obj_lines, write_svg
from meshjig.output.folder import replace_folder
from meshjig.output.lost_colours import lost_colours
from meshjig.output.order import ways_out
from meshjig.output.palette import by_palette
from meshjig.output.pictures.view import axis_of, up_of
from meshjig.output.piece import Piece, explode_pieces
from meshjig.output.plates.printers import Nesting
from meshjig.output.report import Report, write_report
from meshjig.runtime.thresholds import FILES_WORTH_A_CHILD
from meshjig.runtime.worker import Background

__all__ = ["FORMATS", "Outputs", "save_puzzle"]

FORMATS = ("stl", "ply", "3mf", "obj", "glb")
CORE = "core"  # its folder


@dataclass(frozen=True)
class Outputs:
    """What the folder of a puzzle holds beside the report."""

    formats: Sequence[str] = ("stl", "3mf")  # of `FORMATS`
    preview: bool = True  # preview.png
    viewer: bool = True  # viewer.html
    guide: bool = True  # guide.pdf
    plate: str | None = None  # the pieces on plates too, see `parse_plate`
    nest: Nesting = "fast"  # see `lay_out`
    explode: float = 0.6  # how far apart the exploded pieces of the preview, and of a second GLB, are
    turntable: bool = False  # turntable.gif


def save_puzzle(
    directory: str | Path,
    pieces: Sequence[Piece],
    report: Mapping[str, Any],
    outputs: Outputs | None = None,
    *,
    curves: Curves | None = None,
    core: Sequence[Piece] = (),
) -> Report:
    """Write a puzzle to a folder that appears whole or not at all.

    Parameters
    ----------
    directory : path
        An existing folder is replaced only when meshjig made it.
    pieces : sequence of Piece
    report : mapping, what report.json holds; ``up`` in it is which way pictures and GLB show it
    outputs : Outputs
    curves : Curves, the cuts, for SVG, OBJ and DXF
    core : sequence of Piece, what the puzzle is built up on, written to core/

    Returns
    -------
    dict, the report as written, with the seconds for writing and drawing among its timings

    Raises
    ------
    OutputError
        The folder can't be written, or holds something else.
    OptionError
        A format is unknown.
    """
    outputs = outputs or Outputs()
    formats = outputs.formats
    unknown = sorted({formats} if isinstance(formats, str) else set(formats) - set(FORMATS))
    if unknown:
        raise OptionError(f"format: {unknown[0]!r} is not known", hint=f"use a list of {', '.join(FORMATS)}")
    report = _with_notes(report, lost_colours(pieces, formats, outputs.plate is not None))
    seconds = dict(report["timings_s"])
    up = up_of(report, *concatenate(pieces)[:2]) if pieces else axis_of("y")
    ways = ways_out(report, len(pieces))
    source = report.get("input", {}).get("file")
    inputs = [source] if source else []
    with (
        replace_folder(directory, inputs=inputs) as folder,
        _drawn(folder, pieces, outputs, up, ways) as pictures,
    ):
        with _lap(seconds, "write"):
            _write_meshes(folder, pieces, outputs, up, ways)
            _write_core(folder, core)
            _write_curves(folder, curves or Curves())
        plates: dict[str, int] | None = None
        if outputs.plate is not None:
            from meshjig.output.plates.printers import parse_plate
            from meshjig.output.plates.write_plates import write_plates

            with _lap(seconds, "plates"):
                placed = write_plates(folder, [*pieces, *core], parse_plate(outputs.plate), nest=outputs.nest)
            plates = {fact.name: fact.plate for fact in placed if fact.plate}
            report = {**report, "plates": [asdict(fact) for fact in placed]}
        if outputs.viewer:
            from meshjig.output.viewer.page import FILE, write_viewer

            with _lap(seconds, "viewer"):
                write_viewer(folder / FILE, pieces, report, plates=plates, core=core)
        if outputs.guide:
            with _lap(seconds, "guide"):
                _write_guide(folder, pieces, report, plates, pictures)
        seconds |= pictures.result()
        written = {**report, "timings_s": seconds}
        write_report(folder / "report.json", written)
    return written


def _with_notes(report: Mapping[str, Any], notes: Sequence[str]) -> Mapping[str, Any]:
    """A report with more notes, each once."""
    given = report.get("input", {})
    known = given.get("notes", [])
    more = [note for note in notes if note not in known]
    return {**report, "input": {**given, "notes": [*known, *more]}} if more else report


@contextmanager
def _drawn(
    folder: Path, pieces: Sequence[Piece], outputs: Outputs, up: Floats, ways: Floats | None
) -> Iterator[Background]:
    """Draw pictures beside the caller, who asks for the seconds they took once they are needed."""
    small = sum(len(piece.F) for piece in pieces) < FILES_WORTH_A_CHILD
    none = not (outputs.preview or outputs.turntable)
    child = Background(_draw, folder, list(pieces), outputs, up, ways, alone=small or none)
    try:
        yield child
    finally:
        child.cancel()


def _draw(
    folder: Path, pieces: Sequence[Piece], outputs: Outputs, up: Floats, ways: Floats | None
) -> dict[str, float]:
    from meshjig.output.pictures.preview import write_preview, write_turntable

    seconds: dict[str, float] = {}
    if outputs.preview:
        with _lap(seconds, "preview"):
            write_preview(folder / "preview.png", pieces, up, apart=outputs.explode, ways=ways)
    if outputs.turntable:
        with _lap(seconds, "turntable"):
            write_turntable(folder / "turntable.gif", pieces, up)
    return seconds


def _write_guide(
    folder: Path,
    pieces: Sequence[Piece],
    report: Mapping[str, Any],
    plates: Mapping[str, int] | None,
    pictures: Background,
) -> None:
    """Write the guide, with the picture of the preview once that is there, if it is to be."""
    from meshjig.output.guide.guide import FILE, cover_of_preview, write_guide

    def cover() -> NDArray[np.uint8] | None:
        pictures.result()
        drawn = folder / "preview.png"
        return cover_of_preview(drawn) if drawn.exists() else None

    write_guide(folder / FILE, pieces, report, plates=plates, cover=cover)


@contextmanager
def _lap(seconds: dict[str, float], name: str) -> Iterator[None]:
    start = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - start


def _write_meshes(
    folder: Path, pieces: Sequence[Piece], outputs: Outputs, up: Floats, ways: Floats | None
) -> None:
    from meshjig.output.files.glb import write_glb
    from meshjig.output.files.mesh_files import write_obj, write_ply, write_stl

    formats = set(outputs.formats)
    if {"stl", "ply"} & formats:
        (folder / "pieces").mkdir()
    if "ply" in formats:
        for piece in pieces:
            write_ply(folder / "pieces" / f"{piece.name}.ply", piece)
    if "stl" in formats:
        for piece in pieces:
            write_stl(folder / "pieces" / f"{piece.name}.stl", piece.V, piece.F, piece.name)
    if "3mf" in formats:
        from meshjig.output.files.threemf import write_3mf

        write_3mf(folder / "puzzle.3mf", pieces)
    if "obj" in formats:
        write_obj(folder / "puzzle.obj", by_palette(pieces))
    if "glb" in formats:
        shown = by_palette(pieces)
        write_glb(folder / "puzzle.glb", shown, up)
        write_glb(folder / "exploded.glb", explode_pieces(shown, outputs.explode, ways), up)


def _write_core(folder: Path, core: Sequence[Piece]) -> None:
    if not core:
        return
    from meshjig.output.files.mesh_files import write_stl

    (folder / CORE).mkdir()
    for part in core:
        write_stl(folder / CORE / f"{part.name}.stl", part.V, part.F, part.name)


def _write_curves(folder: Path, curves: Curves) -> None:
    if not (len(curves.plane) or len(curves.space)):
        return
    (folder / "curves").mkdir()
    write_svg(folder / "curves" / "cuts.svg", curves.plane)
    write_obj_lines(folder / "curves" / "cuts.obj", curves.space)
    write_dxf(folder / "curves" / "cuts.dxf", curves.space)
