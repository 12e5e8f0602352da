"""PLY files: polygons and strips, with colours and texture coordinates by whatever names are in use."""

from __future__ import annotations

import codecs
from pathlib import Path

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.file_mesh import FileMesh
from meshjig.scan.files.ply_head import parse_head
from meshjig.scan.files.ply_looks import Shown, look_of_ply
from meshjig.scan.files.ply_rows import Broken, Columns, Lists, read_tables
from meshjig.scan.files.strips import strip_triangles
from meshjig.scan.files.surface import surface
from meshjig.scan.files.words import plain, unmarked
from meshjig.scan.source import Source

__all__ = ["read_ply"]

_NOTHING = Columns({}, {}, {})
_WIDE = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE, b"p\0", b"\0p")  # text of two bytes a letter
_CORNERS = ("vertex_indices", "vertex_index", "vertex_indexes", "indices")


def read_ply(path: Path, pictures: PictureReader) -> FileMesh:
    """Read a PLY file.

    Parameters
    ----------
    path : Path
    pictures : PictureReader

    Returns
    -------
    FileMesh
        A face shows its picture, else its own colour, else those of its vertices.

    Raises
    ------
    InputError
        It is cut off, or damaged, or names a pipe or a device.
    """
    data = path.read_bytes()
    if data[:2] in _WIDE:
        data = plain(data)
    data = unmarked(data)
    head = parse_head(data)
    if head is None:
        raise InputError(
            f"{path} can't be read as PLY: its head is damaged or cut off", hint="export it again"
        )
    try:
        tables = read_tables(head, data)
    except Broken as error:
        raise InputError(f"{path} {error}", hint="copy or export it again") from None
    vertices, faces = tables.get("vertex", _NOTHING), tables.get("face", _NOTHING)
    V = _positions(vertices)
    rows = _corners(faces)
    strips = _strips(tables.get("tristrips", _NOTHING))
    corners = np.concatenate([rows.values.astype(np.int64), strips.ravel()])
    sizes = np.concatenate([rows.sizes, np.full(len(strips), 3)])
    made = surface(V, corners, sizes)
    look = look_of_ply(path, pictures, head.pictures, Shown(made, vertices, faces, len(rows.sizes)))
    return FileMesh(Source(V, made.F, look), "meshjig", pictures.notes, len(sizes), made.found)


def _positions(vertices: Columns) -> Floats:
    if not {"x", "y", "z"} <= vertices.scalars.keys():
        return np.zeros((0, 3))
    return np.stack([vertices.scalars[axis].astype(np.float64) for axis in "xyz"], 1)


def _corners(faces: Columns) -> Lists:
    """The corners of polygons, in a list that is called so, or is the only one."""
    for name in _CORNERS:
        if name in faces.lists:
            return faces.lists[name]
    if len(faces.lists) == 1:
        return next(iter(faces.lists.values()))
    return Lists(np.zeros(0, np.int64), np.zeros(0, np.int64))


def _strips(table: Columns) -> Ints:
    """The triangles of strips, (t, 3)."""
    strips = _corners(table)
    return strip_triangles(strips.values.astype(np.int64), strips.sizes)
