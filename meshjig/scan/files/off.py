"""OFF files: polygons, with colours of vertices and faces, normals and texture coordinates."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints, ragged, starts
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.file_mesh import FileMesh
from meshjig.scan.files.formats import half_a_face, off_shortfall
from meshjig.scan.files.looks import corner_colours
from meshjig.scan.files.surface import levels, surface
from meshjig.scan.files.words import Lines, plain, table
from meshjig.scan.source import Look, Source

__all__ = ["read_off"]


_KEYWORD = re.compile(r"((?:ST|C|N)*)(4?)(n?)(?i:OFF)\b\s*(.*)")


class _Head(NamedTuple):
    texture: bool  # what vertices have beside their places
    colours: bool
    normals: bool
    homogeneous: bool
    n_vertices: int
    n_faces: int
    n_lines: int  # that the head takes


def read_off(path: Path, pictures: PictureReader) -> FileMesh:
    """Read an OFF file.

    Parameters
    ----------
    path : Path
    pictures : PictureReader, which an OFF file has no use for

    Returns
    -------
    FileMesh
        A face shows its own colour, else those of its vertices.

    Raises
    ------
    InputError
        It is cut off, or of a kind that is not read.
    """
    data = path.read_bytes()
    lines = Lines(plain(data)).filled()
    head = _head(path, lines)
    shortfall = off_shortfall([str(n).encode() for n in head[4:6]], len(data))
    wanted, held = head.n_vertices + head.n_faces, len(lines) - head.n_lines
    if held < wanted:
        shortfall = shortfall or f"it announces {wanted} vertices and faces and holds {held}"
    elif wanted == held and head.n_faces:
        shortfall = shortfall or half_a_face(lines.line(head.n_lines + wanted - 1))
    if shortfall:
        raise InputError(f"{path} is cut off: {shortfall}", hint="copy or export it again")
    V, colours, uv = _vertices(head, lines.only(head.n_lines + np.arange(head.n_vertices)))
    rows = lines.only(head.n_lines + head.n_vertices + np.arange(head.n_faces))
    values = rows.floats() if b"." in rows.text else rows.integers()
    first = starts(rows.sizes)
    sizes = values[first].astype(np.int64) if len(first) else np.zeros(0, np.int64)
    sizes = np.where((sizes >= 0) & (sizes < rows.sizes), sizes, 0)
    corners = values[ragged(first + 1, sizes)].astype(np.int64)
    made = surface(V, corners, sizes)
    own, notes = _face_colours(values, first + 1 + sizes, rows.sizes - 1 - sizes)
    look = Look(corner_colours(made, own, colours), None if uv is None else uv[made.F])
    return FileMesh(Source(V, made.F, look), "meshjig", notes, head.n_faces, made.found)


def _head(path: Path, lines: Lines) -> _Head:
    """What kind of OFF file it is, and how many vertices and faces it announces."""
    words, n_lines = lines.line(0) if len(lines) else "", 1
    kind = _KEYWORD.match(words)
    beside, homogeneous, other = kind.groups()[:3] if kind else ("", "", "")
    if kind:
        words = kind[4]
        if not words and len(lines) > 1:
            words, n_lines = lines.line(1), 2
    if words.upper().startswith("BINARY") or other:
        raise InputError(
            f"{path} is a binary OFF file, or one of other than three dimensions, which is not read",
            hint="export it as text, or as PLY",
        )
    counts = words.split()
    if len(counts) < 2 or not all(count.isdecimal() for count in counts[:2]):
        raise InputError(
            f"{path} can't be read as OFF: it is damaged or cut off, as it does not say how many vertices and"
            " faces it has",
            hint="export it again",
        )
    n_vertices, n_faces = (int(count[:18]) for count in counts[:2])
    return _Head(
        "ST" in beside, "C" in beside, "N" in beside, bool(homogeneous), n_vertices, n_faces, n_lines
    )


def _vertices(head: _Head, rows: Lines) -> tuple[Floats, NDArray[np.uint8] | None, Floats | None]:
    """Where vertices are (n, 3), their colours (n, 3), and their texture coordinates (n, 2)."""
    at = 3 + head.homogeneous
    width = int(np.bincount(rows.sizes).argmax()) if len(rows) else at
    values = table(rows.floats(), rows.sizes, max(width, at))
    V = values[:, :3].copy()
    if head.homogeneous:
        V /= values[:, 3:4]
    rest = width - at - 3 * head.normals - 2 * head.texture  # columns of colours
    uv = values[:, width - 2 :] if head.texture and rest >= 0 else None
    if rest not in (3, 4):
        return V, None, uv
    shown = values[:, at + 3 * head.normals :][:, :3]
    if not _are_colours(shown):  # MeshLab writes them before the normals
        shown = values[:, at : at + 3]
    return V, levels(shown) if _are_colours(shown) else None, uv


def _are_colours(values: Floats) -> bool:
    """Whether numbers (n, 3) can be colours: 0 to 1, or whole ones up to 255."""
    return bool(
        ((values >= 0) & (values <= 255)).all() and ((values <= 1) | (values == np.rint(values))).all()
    )


def _face_colours(values: NDArray, at: Ints, count: Ints) -> tuple[NDArray[np.uint8] | None, list[str]]:
    """The colours of faces (f, 3), which begin somewhere among all words, and have so many words."""
    some = count >= 3
    if some.any():
        colours = np.full((len(at), 3), np.nan)
        colours[some] = values[at[some][:, None] + np.arange(3)]
        return levels(colours), []
    if (count == 1).any():
        return None, ["its faces name colours of a table that the file does not hold: they are left out"]
    return None, []
