"""Read the objects of a 3MF, each where its build item puts it."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.types import Floats, Ints
from meshjig.mesh.validated import validated, weld
from meshjig.scan.three_mf import open_3mf

__all__ = ["read_3mf"]

_MM = {
    "MicroMeter": 1e-3,
    "MilliMeter": 1.0,
    "CentiMeter": 10.0,
    "Inch": 25.4,
    "Foot": 304.8,
    "Meter": 1000.0,
}


def read_3mf(path: Path) -> list[tuple[str, Floats, Ints]]:
    """Read what a 3MF would have built.

    Parameters
    ----------
    path : Path

    Returns
    -------
    list of (name, V, F)
        V (n, 3) float64, mm, placed; F (m, 3) int64. An object made of components gives one piece a
        component. Objects that no build item names are left out, as a printer would.

    Raises
    ------
    InputError
        No 3MF, nothing to build, or an object that is no mesh.
    """
    import lib3mf

    pieces: list[tuple[str, Floats, Ints]] = []
    try:
        model = open_3mf(path)
        unit = _MM[model.GetUnit().name]
        items = model.GetBuildItems()
        while items.MoveNext():
            item = items.GetCurrent()
            for mesh, placed in _meshes(item.GetObjectResource(), _matrix(item.GetObjectTransform())):
                name = mesh.GetName() or f"{path.stem}_{len(pieces) + 1:03d}"
                V, F = validated(*_geometry(mesh), f"{name} in {path}")
                V, F = weld((V @ placed[:3, :3] + placed[3, :3]) * unit, F)
                pieces.append((name, *validated(V, F, f"{name} in {path}")))
    except lib3mf.ELib3MFException as error:
        raise InputError(f"{path} can't be read as 3MF ({str(error).splitlines()[0]})") from None
    if not pieces:
        raise InputError(f"{path} holds no objects to build")
    return pieces


def _meshes(resource: Any, placed: Floats) -> Iterator[tuple[Any, Floats]]:
    """List the meshes of an object, through its components, each with its place, (4, 4)."""
    if resource.IsMeshObject():
        yield resource, placed
    elif resource.IsComponentsObject():
        for k in range(resource.GetComponentCount()):
            component = resource.GetComponent(k)
            yield from _meshes(component.GetObjectResource(), _matrix(component.GetTransform()) @ placed)


def _matrix(transform: Any) -> Floats:
    """Give a transform as a matrix that multiplies row vectors from the right."""
    matrix = np.eye(4)
    matrix[:, :3] = np.array([list(row) for row in transform.Fields])
    return matrix


def _geometry(mesh: Any) -> tuple[Floats, Ints]:
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
