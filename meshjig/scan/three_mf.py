"""3MF files, opened by lib3mf once it is known that they do not swell beyond measure."""

from __future__ import annotations

import ctypes
import re
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.runtime.bounded import allow_file
from meshjig.runtime.child import allow

__all__ = ["mesh_arrays", "open_3mf", "read_3mf_mesh"]

_SMALL = 64_000_000  # bytes; of this size, anything may be packed into a file
_PACKED = 100  # times as large as the file; text of coordinates becomes at most thirty times larger
_FEW_FACES = 2_000_000  # so many may be made of anything
_DEEPEST = 500  # objects within objects
_FACES_A_BYTE = 5  # of what is unpacked; more only an object makes that places others again and again
_A_FACE = 300.0, 5e-6  # bytes and s that reading takes
_MM = (0.001, 1.0, 10.0, 25.4, 304.8, 1000.0)  # a unit, by lib3mf's number of it


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


def read_3mf_mesh(path: Path) -> tuple[Floats, Ints]:
    """Read all that a 3MF file would have built as one mesh.

    Returns
    -------
    V : (n, 3) float64, mm
    F : (m, 3) int64

    Raises
    ------
    InputError
        As `open_3mf`.
    """
    model = open_3mf(path)
    mm = _MM[int(model.GetUnit())]
    objects = model.MergeToModel().GetMeshObjects()
    V = [np.zeros((0, 3))]
    F = [np.zeros((0, 3), np.int64)]
    n = 0
    while objects.MoveNext():
        mesh = objects.GetCurrentMeshObject()
        points, triangles = mesh_arrays(mesh)
        V.append(points)
        F.append(triangles + n)
        n += len(points)
    return np.concatenate(V) * mm, np.concatenate(F)


def mesh_arrays(mesh: Any) -> tuple[Floats, Ints]:
    """Take over whole buffers: the binding's own getters make a Python object of every vertex."""
    import lib3mf

    library = mesh._wrapper.lib
    V = np.zeros((mesh.GetVertexCount(), 3), np.float32)
    F = np.zeros((mesh.GetTriangleCount(), 3), np.uint32)
    for array, kind, fetch in (
        (V, lib3mf.Position, library.lib3mf_meshobject_getvertices),
        (F, lib3mf.Triangle, library.lib3mf_meshobject_gettriangleindices),
    ):
        if len(array):
            buffer = (kind * len(array)).from_buffer(array)
            needed = ctypes.c_uint64(0)
            mesh._wrapper.checkError(mesh, fetch(mesh._handle, ctypes.c_uint64(len(array)), needed, buffer))
    return V.astype(np.float64), F.astype(np.int64)


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
