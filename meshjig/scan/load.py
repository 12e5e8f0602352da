"""From whatever the user has, a path, a trimesh or arrays, to plain vertices and triangles."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import face_areas
from meshjig.runtime.bounded import OutOfBounds, ReadAhead
from meshjig.scan.files.file_mesh import FileMesh
from meshjig.scan.files.from_trimesh import from_trimesh
from meshjig.scan.source import Source

__all__ = ["Loaded", "load"]

_EXTENTS = (1e-30, 1e30)  # beyond these, products of lengths are no numbers any more


class Loaded(NamedTuple):
    """A mesh as it came."""

    V: Floats  # (n, 3), in the units of the source
    F: Ints  # (m, 3)
    source: Source
    file: str | None  # None for what came as arrays, or from trimesh
    reader: str
    notes: list[str]  # what of the file was left out, a sentence each
    sha256: str | None = None  # of the file


def load(source: Any) -> Loaded:
    """Read a mesh.

    Files are read in a process of its own, see `read_file`, so that a crash in native code ends as a
    sentence.

    Parameters
    ----------
    source : path, ReadAhead, trimesh.Trimesh, trimesh.Scene, or (V (n, 3), F (m, 3))

    Returns
    -------
    Loaded
        Checked for shape and finite numbers, not for topology.

    Raises
    ------
    InputError
        The file is missing, a folder, of unknown format, empty, damaged or cut off; or the mesh has
        points only, no faces, no area, coordinates that are no numbers, or indices out of range.
    """
    if isinstance(source, str | os.PathLike):
        source = ReadAhead(source)
    if isinstance(source, ReadAhead):
        read = _read(source)
        V, F = _checked(read.source, Path(source.path).name)
        return Loaded(V, F, read.source, source.path, read.reader, read.notes, read.sha256)
    if isinstance(source, tuple | list) and len(source) == 2:
        mesh = _from_arrays(*source)
        return Loaded(*_checked(mesh, "the mesh"), mesh, None, "arrays", [])
    if hasattr(source, "vertices") or hasattr(source, "geometry"):
        mesh = from_trimesh(source)
        return Loaded(*_checked(mesh, "the mesh"), mesh, None, "trimesh", [])
    raise InputError(f"a {type(source).__name__} is no mesh", hint="give a path, a trimesh.Trimesh or (V, F)")


def _read(reading: ReadAhead) -> FileMesh:
    try:
        return reading.result()
    except OutOfBounds as error:
        tail = (
            ", and it is damaged or cut off" if error.crashed else ", more than a sound file of its size does"
        )
        raise InputError(f"{reading.path} {error}{tail}", hint="export it again") from None


def _from_arrays(V: Any, F: Any, name: str = "the mesh") -> Source:
    """Make a mesh of arrays, after checking that they are such."""
    try:
        V, F = np.asarray(V), np.asarray(F)
        if V.dtype.kind not in "fiu":
            raise InputError(f"V holds {V.dtype}", hint="vertices are coordinates, of a real type")
    except ValueError:
        raise InputError(
            "the rows of V or F differ in length", hint="split polygons into triangles"
        ) from None
    if V.ndim != 2 or V.shape[1] != 3:
        raise InputError(f"V has shape {V.shape}", hint="vertices are an (n, 3) array")
    if F.size and (F.ndim != 2 or F.shape[1] != 3):
        raise InputError(
            f"F has shape {F.shape}", hint="faces are an (m, 3) array: split polygons into triangles"
        )
    if F.size and F.dtype.kind not in "iu":
        raise InputError(f"F holds {F.dtype}", hint="faces are indices into V, of an integer type")
    F = F.reshape(-1, 3).astype(np.int64)
    _check_range(F, len(V), name)
    return Source(V.astype(np.float64), F)


def _checked(mesh: Source, name: str) -> tuple[Floats, Ints]:
    """The arrays of a mesh, if they are a surface."""
    V, F = mesh.vertices, mesh.faces
    if not len(F):
        if len(V):
            raise InputError(
                f"{name} holds {len(V)} points but no faces",
                hint="make a surface of the points first, or export it again if it is cut off",
            )
        raise InputError(f"{name} holds no faces", hint="export it as a triangle mesh")
    _check_range(F, len(V), name)
    used = np.zeros(len(V), bool)
    used[F] = True
    bad = np.flatnonzero(used & ~np.isfinite(V).all(axis=1))
    if len(bad):
        raise InputError(
            f"{name} has coordinates that are not numbers (NaN or infinite)"
            f" in {len(bad)} of its {len(V)} vertices",
            hint="remove them, or export it again",
            ids=bad[:100].tolist(),
        )
    _check_area(V, F, V[used], name)
    return V, F


def _check_range(F: Ints, n: int, name: str) -> None:
    out = np.flatnonzero(((F < 0) | (n <= F)).any(axis=1))
    if len(out):
        raise InputError(
            f"{name} has {n} vertices and names others"
            f" in {len(out)} of its {len(F)} faces (first: face {out[0]})",
            hint="it may be cut off; export it again",
            ids=out[:100].tolist(),
        )


def _check_area(V: Floats, F: Ints, used: Floats, name: str) -> None:
    extent = float(np.ptp(used, axis=0).max())
    if np.abs(used).max() > _EXTENTS[1] or 0 < extent < _EXTENTS[0]:
        raise InputError(f"{name} has an extent of {extent:g}, beyond any unit", hint="export it again")
    if not 2 * face_areas(V / (extent or 1.0), F).sum() > 1e-12:
        raise InputError(f"{name} has no area: all its faces are points or lines", hint="export it again")
