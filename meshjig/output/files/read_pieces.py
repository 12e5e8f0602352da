"""Read pieces back from files, whatever wrote them."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.validated import validated, weld
from meshjig.output.files.read_parts import NamedPiece, is_own_obj, read_glb, read_own_obj, read_text_stl
from meshjig.output.files.threemf import read_3mf
from meshjig.output.report import Report, read_report
from meshjig.runtime.bounded import Bounded, OutOfBounds, allow_file
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.formats import ply_shortfall
from meshjig.scan.files.reading import check_file, load_by_trimesh
from meshjig.scan.files.stl import is_text_stl

__all__ = ["PuzzleFiles", "read_core", "read_pieces", "read_puzzle_files"]


MESHES = (".stl", ".obj", ".ply")  # a piece a file, but for an OBJ that meshjig wrote
PACKAGES = (".3mf", ".glb")
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read_pieces(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]]) -> list[NamedPiece]:
    """Read the pieces of a puzzle.

    Parameters
    ----------
    paths : path, or several
        A folder that meshjig made (its pieces/, else its puzzle.3mf, .glb or .obj), any folder of
        STL, OBJ or PLY files, single files of these, a 3MF or a GLB. A mesh file is one piece; a 3MF
        or GLB holds one piece an object, in its place, and so does an OBJ that meshjig wrote.

    Returns
    -------
    list of (name, V, F)
        V (n, 3) float64, in the unit of the file (mm for 3MF and GLB); F (m, 3) int64. Vertices with equal
        coordinates are one. Files of a folder come in natural order: piece_2 before piece_10.

    Raises
    ------
    InputError
        Nothing found, or a file that can't be read.
    """
    given = [paths] if isinstance(paths, str | os.PathLike) else list(paths)
    if not given:
        raise InputError("no files to read", hint="name a folder of pieces, mesh files or a 3MF")
    pieces: list[NamedPiece] = []
    for path in (file for item in given for file in _files(Path(item))):
        pieces += _read(path)
    return pieces


def read_core(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]]) -> list[NamedPiece]:
    """Read the parts of the core that meshjig wrote beside the pieces.

    Parameters
    ----------
    paths : path, or several
        As for `read_pieces`. Only a single folder has a core.

    Returns
    -------
    list of (name, V, F), empty where there is none

    Raises
    ------
    InputError
        A file can't be read.
    """
    given = [paths] if isinstance(paths, str | os.PathLike) else list(paths)
    files = _meshes(Path(given[0]) / "core") if len(given) == 1 else []
    return [part for file in files for part in _read(file)]


def _read(path: Path) -> list[NamedPiece]:
    """Read the pieces of one file."""
    check_file(path)
    allow_file(path)
    try:
        if path.suffix.lower() == ".3mf":
            return read_3mf(path)
        if path.suffix.lower() == ".glb":
            return read_glb(path)
        return read_own_obj(path) if is_own_obj(path) else [_read_mesh(path)]
    except OSError as error:
        raise InputError(f"{path} can't be read ({(error.strerror or str(error)).lower()})") from None


def _files(path: Path) -> list[Path]:
    """List the files that hold the pieces of a path."""
    if not path.exists():
        raise InputError(f"{path} does not exist")
    if not path.is_dir():
        if path.suffix.lower() not in (*MESHES, *PACKAGES):
            raise InputError(
                f"{path} is of an unknown format", hint="pieces are read from STL, OBJ, PLY, 3MF and GLB"
            )
        return [path]
    whole = [[p] for p in (path / f"puzzle{suffix}" for suffix in (".3mf", ".glb", ".obj")) if p.is_file()]
    lone = [p for p in path.iterdir() if p.suffix.lower() in PACKAGES]
    for found in (_meshes(path / "pieces"), *whole, _meshes(path), lone if len(lone) == 1 else []):
        if found:
            return found
    raise InputError(
        f"no pieces found in {path}", hint="name a folder of STL, OBJ or PLY files, or one 3MF or GLB"
    )


def _meshes(folder: Path) -> list[Path]:
    """List the mesh files of a folder in natural order; of one format only, lest a piece come twice."""
    files = list(folder.iterdir()) if folder.is_dir() else []
    for suffix in MESHES:
        found = [p for p in files if p.suffix.lower() == suffix and p.is_file()]
        if found:
            return sorted(found, key=_natural)
    return []


def _natural(path: Path) -> list[Any]:
    return [
        (0, int(part), "") if part.isdigit() else (1, 0, part)
        for part in re.split(r"(\d+)", path.name)
        if part
    ]


def _read_mesh(path: Path) -> NamedPiece:
    V, F = _binary_stl(path) if path.suffix.lower() == ".stl" else (None, None)
    if V is None:
        V, F = _by_reader(path)
    V, F = validated(V, F, str(path))
    return path.stem, *validated(*weld(V, F), str(path))


def _binary_stl(path: Path) -> tuple[Any, Any]:
    """A soup of corners, or (None, None) where the file is no binary STL."""
    data = path.read_bytes()
    if len(data) == 0:
        raise InputError(f"{path} is empty")
    n = int.from_bytes(data[80:84], "little") if len(data) >= 84 else 0
    wanted = 84 + n * _FACET.itemsize
    if len(data) < 84 or (is_text_stl(data) and len(data) != wanted):
        return None, None
    if len(data) < wanted:
        raise InputError(f"{path} is cut short: it announces {n} facets, and holds {(len(data) - 84) // 50}")
    corners = np.frombuffer(data, _FACET, count=n, offset=84)["corners"].astype(np.float64).reshape(-1, 3)
    return corners, np.arange(3 * n).reshape(-1, 3)


def _by_reader(path: Path) -> tuple[Any, Any]:
    shortfall = ply_shortfall(path) if path.suffix.lower() == ".ply" else ""
    if shortfall:
        raise InputError(f"{path} is cut off: {shortfall}", hint="export it again")
    try:
        if path.suffix.lower() == ".stl":
            return read_text_stl(path)
        mesh = load_by_trimesh(path, PictureReader(), force="mesh", skip_materials=True)
        return np.asarray(mesh.vertices), np.asarray(mesh.faces)
    except InputError:
        raise
    except Exception as error:  # readers raise whatever their parsers do
        raise InputError(f"{path} can't be read as {path.suffix[1:].upper()} ({_one_line(error)})") from None


def _one_line(error: Exception) -> str:
    return (str(error).strip() or type(error).__name__).splitlines()[0]


class PuzzleFiles(NamedTuple):
    """What a folder, or files, of pieces hold."""

    pieces: list[NamedPiece]
    core: list[NamedPiece]
    report: Report | None  # None where there is none


def read_puzzle_files(paths: Sequence[str | os.PathLike[str]]) -> PuzzleFiles:
    """Read pieces, core and report in a process of its own, within limits of memory and time.

    Parameters
    ----------
    paths : see `read_pieces`. Only a single folder has a core, and a report.

    Raises
    ------
    InputError
        Nothing found, or a file that can't be read.
    """
    given = [os.fspath(path) for path in paths]
    try:
        return Bounded(__name__, "_read_all", given).result()
    except OutOfBounds as error:
        name = given[0] if len(given) == 1 else f"one of {len(given)} files"
        raise InputError(f"{name} {error}", hint="export it again, or give its files one by one") from None


def _read_all(paths: list[str]) -> PuzzleFiles:
    report = Path(paths[0]) / "report.json" if len(paths) == 1 else None
    there = report is not None and os.path.lexists(report)
    return PuzzleFiles(
        read_pieces(paths), read_core(paths), read_report(report) if report and there else None
    )
