"""A whole puzzle in a folder: pieces, 3MF and the like, preview, viewer, guide, curves, report."""

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import OptionError
from meshjig.mesh.types import Floats
from meshjig.output.folder import replace_folder
from meshjig.output.piece import Piece
from meshjig.runtime.worker import Background

__all__ = ["FORMATS", "save_puzzle"]

FORMATS = ("stl", "ply", "3mf", "obj", "glb")
CORE = "core"  # its folder
WORTH_A_CHILD = 60_000  # faces; below, a child process takes longer to start than it saves


def save_puzzle(
    directory: str | Path,
    pieces: Sequence[Piece],
    report: Mapping[str, Any],
    *,
    formats: Sequence[str] = ("stl", "3mf"),
    plane_curves: Sequence[Floats] = (),
    space_curves: Sequence[Floats] = (),
    preview: bool = True,
    viewer: bool = True,
    guide: bool = True,
    plate: str | None = None,
    nest: Literal["fast", "tight"] = "fast",
    explode: float = 0.6,
    turntable: bool = False,
    core: Sequence[Piece] = (),
) -> dict[str, Any]:
    """Write a puzzle to a folder that appears whole or not at all.

    Parameters
    ----------
    directory : path
        An existing folder is replaced only when meshjig made it.
    pieces : sequence of Piece
    report : mapping, what report.json holds
    formats : sequence of "stl", "ply", "3mf", "obj", "glb"
    plane_curves : sequence of (k, 2) float64, mm; cut curves for SVG
    space_curves : sequence of (k, 3) float64, mm; cut curves for OBJ and DXF
    preview : bool, also draw preview.png
    viewer : bool, also write viewer.html
    guide : bool, also write guide.pdf
    plate, nest : str, also lay the pieces on plates, see `write_plates`
    explode : float, how far apart the exploded pieces of the preview, and of a second GLB, are
    turntable : bool, also draw turntable.gif
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
    unknown = sorted({formats} if isinstance(formats, str) else set(formats) - set(FORMATS))
    if unknown:
        raise OptionError(f"format: {unknown[0]!r} is not known", hint=f"use a list of {', '.join(FORMATS)}")
    seconds = dict(report["timings_s"])
    source = report.get("input", {}).get("file")
    inputs = [source] if source else []
    with (
        replace_folder(directory, inputs=inputs) as folder,
        _drawn(folder, pieces, preview, turntable, explode) as pictures,
    ):
        with _lap(seconds, "write"):
            _write_meshes(folder, pieces, formats, explode)
            _write_core(folder, core)
            _write_curves(folder, plane_curves, space_curves)
        plates: dict[str, int] | None = None
        if plate is not None:
            from meshjig.output.plates.printers import parse_plate
            from meshjig.output.plates.write_plates import write_plates

            with _lap(seconds, "plates"):
                parts = [*pieces, *core]
                laid = write_plates(
                    folder, parts, parse_plate(plate), nest=nest, outer_normals=_normals(parts)
                )
            plates = {fact["name"]: fact["plate"] for fact in laid if fact["plate"]}
            report = {**report, "plates": laid}
        if viewer:
            from meshjig.output.viewer.page import FILE, write_viewer

            with _lap(seconds, "viewer"):
                write_viewer(folder / FILE, pieces, report, plates=plates, core=core)
        if guide:
            with _lap(seconds, "guide"):
                _write_guide(folder, pieces, report, plates, pictures)
        seconds |= pictures.result()
        from meshjig.output.files.report_file import write_report

        written = {**report, "timings_s": seconds}
        write_report(folder / "report.json", written)
    return written


@contextmanager
def _drawn(
    folder: Path, pieces: Sequence[Piece], preview: bool, turntable: bool, explode: float
) -> Iterator[Background]:
    """Draw pictures beside the caller, who asks for the seconds they took once they are needed."""
    small = sum(len(piece.F) for piece in pieces) < WORTH_A_CHILD
    none = not (preview or turntable)
    child = Background(_draw, folder, list(pieces), preview, turntable, explode, alone=small or none)
    try:
        yield child
    finally:
        child.cancel()


def _draw(
    folder: Path, pieces: Sequence[Piece], preview: bool, turntable: bool, explode: float
) -> dict[str, float]:
    seconds: dict[str, float] = {}
    if preview:
        from meshjig.output.pictures.preview import preview as draw

        with _lap(seconds, "preview"):
            draw(pieces, folder / "preview.png", apart=explode)
    if turntable:
        from meshjig.output.pictures.turntable import write_turntable

        with _lap(seconds, "turntable"):
            write_turntable(folder / "turntable.gif", pieces)
    return seconds


def _normals(pieces: Sequence[Piece]) -> Floats | None:
    """Give the outer normals of all pieces, zero where one is not known; None where none is."""
    if all(piece.outer_normal is None for piece in pieces):
        return None
    zero: Floats = np.zeros(3)
    return np.array([zero if piece.outer_normal is None else piece.outer_normal for piece in pieces])


def _write_guide(
    folder: Path,
    pieces: Sequence[Piece],
    report: Mapping[str, Any],
    plates: Mapping[str, int] | None,
    pictures: Background,
) -> None:
    """Write the guide, with the picture of the preview once that is there, if it is to be."""
    from meshjig.output.guide.cover import cover_of_preview
    from meshjig.output.guide.guide import FILE, write_guide

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


def _write_meshes(folder: Path, pieces: Sequence[Piece], formats: Sequence[str], explode: float) -> None:
    if {"stl", "ply"} & set(formats):
        (folder / "pieces").mkdir()
    if "ply" in formats:
        from meshjig.output.files.ply import write_ply

        for piece in pieces:
            write_ply(folder / "pieces" / f"{piece.name}.ply", piece)
    if "stl" in formats:
        from meshjig.output.files.stl import write_stl

        for piece in pieces:
            write_stl(folder / "pieces" / f"{piece.name}.stl", piece.V, piece.F, piece.name)
    if "3mf" in formats:
        from meshjig.output.files.threemf import write_3mf

        write_3mf(folder / "puzzle.3mf", pieces)
    if "obj" in formats:
        from meshjig.output.files.obj import write_obj

        write_obj(folder / "puzzle.obj", pieces)
    if "glb" in formats:
        from meshjig.output.files.glb import write_glb
        from meshjig.output.pictures.explosion import explode_pieces

        write_glb(folder / "puzzle.glb", pieces)
        write_glb(folder / "exploded.glb", explode_pieces(pieces, explode))


def _write_core(folder: Path, core: Sequence[Piece]) -> None:
    if not core:
        return
    from meshjig.output.files.stl import write_stl

    (folder / CORE).mkdir()
    for part in core:
        write_stl(folder / CORE / f"{part.name}.stl", part.V, part.F, part.name)


def _write_curves(folder: Path, plane: Sequence[Floats], space: Sequence[Floats]) -> None:
    if not (len(plane) or len(space)):
        return
    from meshjig.output.files.curve_files import write_dxf, write_obj_lines, write_svg

    (folder / "curves").mkdir()
    write_svg(folder / "curves" / "cuts.svg", plane)
    write_obj_lines(folder / "curves" / "cuts.obj", space)
    write_dxf(folder / "curves" / "cuts.dxf", space)
