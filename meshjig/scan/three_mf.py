"""3MF files, opened by lib3mf once it is known that they do not swell beyond measure."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.runtime.bounded import allow_file
from meshjig.runtime.child import allow
from meshjig.types import Floats, Ints

__all__ = ["open_3mf", "read_3mf_mesh"]

_SMALL = 64_000_000  # bytes; of this size, anything may be packed into a file
_PACKED = 100  # times as large as the file; text of coordinates becomes at most thirty times larger
_FEW_FACES = 2_000_000  # so many may be made of anything
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
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
        raise InputError(
            f"{path} can't be read as 3MF: it is no whole archive", hint="export it again"
        ) from None
    if unpacked > max(_SMALL, _PACKED * size):
        raise InputError(
            f"{path} has {size} bytes and would unpack to {unpacked}: far more than a mesh does",
            hint="export it again, without attachments",
        )
    allow_file(path, share=unpacked / max(size, 1))
    try:
        model = lib3mf.get_wrapper().CreateModel()
        model.QueryReader("3mf").ReadFromFile(str(path))
        faces = _faces_placed(model)
    except lib3mf.ELib3MFException as error:
        reason = str(error).splitlines()[0]
        raise InputError(f"{path} can't be read as 3MF ({reason})", hint="export it again") from None
    if faces > max(_FEW_FACES, _FACES_A_BYTE * unpacked):
        raise InputError(
            f"{path} places its objects so often that they have {faces:.3g} faces together",
            hint="export fewer copies",
        )
    allow(_A_FACE[0] * faces, _A_FACE[1] * faces)
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
    import lib3mf

    model = open_3mf(path)
    mm = _MM[int(model.GetUnit())]
    objects = model.MergeToModel().GetMeshObjects()
    V: list[Any] = [np.zeros((0, 3))]
    F: list[Any] = [np.zeros((0, 3), np.int64)]
    n = 0
    while objects.MoveNext():
        mesh = objects.GetCurrentMeshObject()
        points, triangles = mesh.GetVertices(), mesh.GetTriangleIndices()
        V.append(np.frombuffer((lib3mf.Position * len(points))(*points), np.float32).reshape(-1, 3))
        F.append(np.frombuffer((lib3mf.Triangle * len(triangles))(*triangles), np.uint32).reshape(-1, 3) + n)
        n += len(points)
    return np.concatenate(V).astype(np.float64) * mm, np.concatenate(F).astype(np.int64)


def _faces_placed(model: Any) -> int:
    """Count the faces of all that is built, without building it: an object may place others many times."""
    faces: dict[int, int] = {}
    objects = model.GetObjects()
    while objects.MoveNext():  # components are of objects that come before
        thing = objects.GetCurrentObject()
        if thing.IsMeshObject():
            faces[thing.GetResourceID()] = thing.GetTriangleCount()
        elif thing.IsComponentsObject():
            parts = (thing.GetComponent(k).GetObjectResource() for k in range(thing.GetComponentCount()))
            faces[thing.GetResourceID()] = sum(faces.get(part.GetResourceID(), 0) for part in parts)
    items = model.GetBuildItems()
    total = 0
    while items.MoveNext():
        total += faces.get(items.GetCurrent().GetObjectResource().GetResourceID(), 0)
    return total
