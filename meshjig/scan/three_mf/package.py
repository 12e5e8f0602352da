"""3MF files, opened by lib3mf once it is known that they do not swell beyond measure."""

from __future__ import annotations

import ctypes
import re
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.runtime.bounded import allow_file
from meshjig.runtime.child import allow
from meshjig.scan.source import Unit

__all__ = ["matrix_of", "mesh_arrays", "open_3mf", "unit_of", "whole_buffer"]

_SMALL = 64_000_000  # bytes; of this size, anything may be packed into a file
_PACKED = 100  # times as large as the file; text of coordinates becomes at most thirty times larger
_FEW_FACES = 2_000_000  # so many may be made of anything
_DEEPEST = 500  # objects within objects
_FACES_A_BYTE = 5  # of what is unpacked; more only an object makes that places others again and again
_A_FACE = 300.0, 5e-6  # bytes and s that reading takes


_UNITS = (  # by lib3mf's number
    Unit(0.001, "micron", binding=True),
    Unit(1.0, "millimetre", binding=True),
    Unit(10.0, "centimetre", binding=True),
    Unit(25.4, "inch", binding=True),
    Unit(304.8, "foot", binding=True),
    Unit(1000.0, "metre", binding=True),
)


def open_3mf(path: Path) -> Any:
    """Open a 3MF file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    lib3mf.Model

    Raises
    ------
    InputError
        It is damaged, or what it unpacks to, or places again and again, is beyond all measure.
    """
    import lib3mf

    size = path.stat().st_size
    try:
        with zipfile.ZipFile(path) as archive:
            unpacked = sum(entry.file_size for entry in archive.infolist())
            if unpacked > max(_SMALL, _PACKED * size):
                raise InputError(
                    f"{path} has {size} bytes and would unpack to {unpacked}: far more than a mesh does",
                    hint="export it again, without attachments",
                )
            allow_file(path, share=unpacked / max(size, 1))
            faces, depth = _faces_placed(archive)
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, ValueError, NotImplementedError):
        raise InputError(
            f"{path} can't be read as 3MF: its archive is not whole", hint="export it again"
        ) from None
    if faces > max(_FEW_FACES, _FACES_A_BYTE * unpacked):
        raise InputError(
            f"{path} places its objects so often that they have {faces:.3g} faces together",
            hint="export fewer copies",
        )
    if depth > _DEEPEST:
        raise InputError(f"{path} nests its objects {depth} deep", hint="export it without groups")
    allow(_A_FACE[0] * faces, _A_FACE[1] * faces)
    try:
        model = lib3mf.get_wrapper().CreateModel()
        model.QueryReader("3mf").ReadFromFile(str(path))
    except lib3mf.ELib3MFException as error:
        reason = str(error).splitlines()[0]
        raise InputError(f"{path} can't be read as 3MF ({reason})", hint="export it again") from None
    return model


def unit_of(model: Any) -> Unit:
    """Give the unit that a lib3mf.Model states."""
    return _UNITS[int(model.GetUnit())]


def matrix_of(transform: Any) -> Floats:
    """Give a lib3mf.Transform as a matrix, (4, 4), that multiplies row vectors from the right."""
    matrix = np.eye(4)
    matrix[:, :3] = np.array([list(row) for row in transform.Fields])
    return matrix


def mesh_arrays(mesh: Any) -> tuple[Floats, Ints]:
    """Give the vertices (n, 3) float64 and triangles (m, 3) int64 of a lib3mf.MeshObject."""
    import lib3mf

    library = mesh._wrapper.lib
    V = whole_buffer(mesh, library.lib3mf_meshobject_getvertices, lib3mf.Position, mesh.GetVertexCount())
    F = whole_buffer(
        mesh, library.lib3mf_meshobject_gettriangleindices, lib3mf.Triangle, mesh.GetTriangleCount()
    )
    return V.view(np.float32).reshape(-1, 3).astype(np.float64), F.reshape(-1, 3).astype(np.int64)


def whole_buffer(thing: Any, fetch: Any, kind: Any, count: int) -> NDArray[np.uint32]:
    """Take over a whole buffer: the binding's own getters make a Python object of every row.

    Parameters
    ----------
    thing : a lib3mf object
    fetch : function of lib3mf's library that fills a buffer
    kind : ctypes type of a row, a multiple of four bytes long
    count : int, of rows

    Returns
    -------
    (count, words) uint32, the bytes as they are
    """
    rows = np.zeros((count, ctypes.sizeof(kind) // 4), np.uint32)
    if count:
        buffer = (kind * count).from_buffer(rows)
        needed = ctypes.c_uint64(0)
        thing._wrapper.checkError(thing, fetch(thing._handle, ctypes.c_uint64(count), needed, buffer))
    return rows


def _faces_placed(archive: zipfile.ZipFile) -> tuple[int, int]:
    """Count the faces of all that is built, and how deep objects are nested, before anything is made.

    An object may place others, which come before it, many times.
    """
    faces: dict[tuple[str, bytes], int] = {}
    depth: dict[tuple[str, bytes], int] = {}
    built: list[tuple[str, bytes]] = []
    for name in archive.namelist():
        if not name.lower().endswith(".model"):
            continue
        text = archive.read(name)
        starts = [match.start() for match in _OBJECT.finditer(text)]
        for start, end in zip(starts, [*starts[1:], len(text)], strict=True):
            part = text[start:end]
            placed = [_named(tag[0], name) for tag in _COMPONENT.finditer(part)]
            thing = _named(_TAG.match(part), name, b"id")
            faces[thing] = part.count(b"<triangle ") or sum(faces.get(key, 0) for key in placed)
            depth[thing] = 1 + max((depth.get(key, 0) for key in placed), default=0)
        built += [_named(tag[0], name) for tag in _ITEM.finditer(text)]
    return sum(faces.get(key, 0) for key in built), max(depth.values(), default=0)


def _named(tag: Any, file: str, word: bytes = b"objectid") -> tuple[str, bytes]:
    """The file and the number of the object that a tag is, or is of."""
    text = tag if isinstance(tag, bytes) else tag[0] if tag else b""
    number = re.search(rb"\b" + word + rb'\s*=\s*["\'](\d+)', text)
    path = re.search(rb"\bpath\s*=\s*[\"']/?([^\"']*)", text)
    return path[1].decode("utf-8", "replace") if path else file, number[1] if number else b""


_TAG = re.compile(rb"<[^>]*>")
_OBJECT = re.compile(rb"<(?:\w+:)?object\b")
_COMPONENT = re.compile(rb"<(?:\w+:)?component\b[^>]*>")
_ITEM = re.compile(rb"<(?:\w+:)?item\b[^>]*>")
