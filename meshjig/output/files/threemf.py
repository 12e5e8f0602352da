"""3MF by lib3mf: one named and coloured object a piece."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError, OutputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.validated import validated, weld
from meshjig.output.piece import Piece
from meshjig.output.texture import Texture
from meshjig.scan.three_mf import mesh_arrays, open_3mf

__all__ = ["read_3mf", "write_3mf"]


_MM = {
    "MicroMeter": 1e-3,
    "MilliMeter": 1.0,
    "CentiMeter": 10.0,
    "Inch": 25.4,
    "Foot": 304.8,
    "Meter": 1000.0,
}


def write_3mf(path: Path, pieces: Iterable[Piece], title: str = "meshjig puzzle") -> None:
    """Write pieces as one 3MF, each an object of its own in its assembled position, mm.

    Colours are base materials of the core specification, one a piece, since every reader knows those.
    The picture of a scan becomes colours of the materials extension at the corners of triangles.

    Parameters
    ----------
    path : Path
    pieces : Piece
        Closed and oriented; ``printable`` makes the coordinates equal to those of the STL files.
    title : str, metadata

    Raises
    ------
    OutputError
        lib3mf refuses the pieces or the path.
    """
    import lib3mf

    wrapper = lib3mf.get_wrapper()
    try:
        model = wrapper.CreateModel()
        model.SetUnit(lib3mf.ModelUnit.MilliMeter)
        metadata = model.GetMetaDataGroup()
        metadata.AddMetaData("", "Title", title, "xs:string", True)
        metadata.AddMetaData("", "Application", "meshjig", "xs:string", True)
        materials = model.AddBaseMaterialGroup()
        identity = wrapper.GetIdentityTransform()
        for number, piece in enumerate(pieces, 1):
            mesh = model.AddMeshObject()
            mesh.SetName(piece.name)
            mesh.SetPartNumber(str(number))
            _set_geometry(wrapper, mesh, piece)
            red, green, blue = (round(255 * channel) for channel in piece.colour)
            material = materials.AddMaterial(piece.name, wrapper.RGBAToColor(red, green, blue, 255))
            mesh.SetObjectLevelProperty(materials.GetResourceID(), material)
            if piece.texture is not None:
                _set_colours(wrapper, model, mesh, piece.texture)
            model.AddBuildItem(mesh, identity)
        model.QueryWriter("3mf").WriteToFile(str(path))
    except lib3mf.ELib3MFException as error:
        raise OutputError(f"{path.name} can't be written: {error}") from error


def _set_geometry(wrapper: Any, mesh: Any, piece: Piece) -> None:
    """Hand over whole buffers: the binding's own SetGeometry copies every vertex through Python."""
    import lib3mf

    V = np.array(piece.V, np.float32, order="C")
    F = np.array(piece.F, np.uint32, order="C")
    vertices = (lib3mf.Position * len(V)).from_buffer(V)
    triangles = (lib3mf.Triangle * len(F)).from_buffer(F)
    status = wrapper.lib.lib3mf_meshobject_setgeometry(
        mesh._handle, ctypes.c_uint64(len(V)), vertices, ctypes.c_uint64(len(F)), triangles
    )
    wrapper.checkError(mesh, status)


def _set_colours(wrapper: Any, model: Any, mesh: Any, texture: Texture) -> None:
    """Give the corners of a mesh their colours, rounded to 32 steps a channel: a group holds each once."""
    import lib3mf

    steps = np.rint(31 * texture.rgb.reshape(-1, 3)).astype(np.int64)
    distinct, number = np.unique(steps @ np.array([1024, 32, 1]), return_inverse=True)
    group = model.AddColorGroup()
    channels = np.rint(np.stack([distinct // 1024, distinct // 32 % 32, distinct % 32], 1) * 255 / 31)
    ids = np.array([group.AddColor(wrapper.RGBAToColor(*map(int, rgb), 255)) for rgb in channels], np.uint32)
    rows = np.empty((len(texture.rgb), 4), np.uint32)
    rows[:, 0] = group.GetResourceID()
    rows[:, 1:] = ids[number].reshape(-1, 3)
    properties = (lib3mf.TriangleProperties * len(rows)).from_buffer(rows)
    status = wrapper.lib.lib3mf_meshobject_setalltriangleproperties(
        mesh._handle, ctypes.c_uint64(len(rows)), properties
    )
    wrapper.checkError(mesh, status)


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
                V, F = validated(*mesh_arrays(mesh), f"{name} in {path}")
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
    """A transform as a matrix that multiplies row vectors from the right."""
    matrix = np.eye(4)
    matrix[:, :3] = np.array([list(row) for row in transform.Fields])
    return matrix
