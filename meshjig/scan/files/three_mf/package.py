"""3MF files, opened by lib3mf once it is known that they do not swell beyond measure."""

from __future__ import annotations

import ctypes
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
from meshjig.scan.files.three_mf.extensions import unknown_extension
from meshjig.scan.files.three_mf.flat import without_flat_triangles
from meshjig.scan.files.three_mf.placed import faces_placed
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
    Unit(1.0, "mm", binding=True),
    Unit(10.0, "cm", binding=True),
    Unit(25.4, "inch", binding=True),
    Unit(304.8, "foot", binding=True),
    Unit(1000.0, "m", binding=True),
)


def open_3mf(path: Path, notes: list[str] | None = None) -> Any:
    """Open a 3MF file.

    Parameters
    ----------
    path : Path
    notes : list of str, optional, to which a sentence is added where triangles are left out

    Returns
    -------
    lib3mf.Model

    Raises
    ------
    InputError
        It is damaged, requires an extension that is not known, or what it unpacks to, or places again and
        again, is beyond all measure.
    """
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
            faces, depth = faces_placed(archive)
            unknown = unknown_extension(archive)
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
    if unknown is not None:
        raise InputError(
            f"{path} needs {unknown}, an extension that meshjig does not know",
            hint="export it without that extension",
        )
    allow(_A_FACE[0] * faces, _A_FACE[1] * faces)
    return _model(path, [] if notes is None else notes)


def _model(path: Path, notes: list[str]) -> Any:
    import lib3mf

    wrapper = lib3mf.get_wrapper()
    try:
        model = wrapper.CreateModel()
        model.QueryReader("3mf").ReadFromFile(str(path))
        return model
    except lib3mf.ELib3MFException as error:
        reason = str(error).splitlines()[0]
    with zipfile.ZipFile(path) as archive:
        data, count = without_flat_triangles(archive)
    if count:
        model = wrapper.CreateModel()
        reader = model.QueryReader("3mf")
        buffer = (ctypes.c_uint8 * len(data)).from_buffer(bytearray(data))
        try:
            read = wrapper.lib.lib3mf_reader_readfrombuffer
            wrapper.checkError(reader, read(reader._handle, ctypes.c_uint64(len(data)), buffer))
        except lib3mf.ELib3MFException as error:
            reason = str(error).splitlines()[0]
        else:
            notes.append(
                f"left out: {count} triangle{'s' * (count > 1)} with a corner twice, without any area"
            )
            return model
    raise InputError(f"{path} can't be read as 3MF ({reason})", hint="export it again")


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
