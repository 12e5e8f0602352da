"""3MF by lib3mf: one named and coloured object a piece."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any
from uuid import UUID

import numpy as np

from meshjig.errors import InputError, OutputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.validated import validated, weld
from meshjig.output.files.threemf_looks import LooksOf3mf
from meshjig.output.piece import Piece
from meshjig.scan.files.three_mf import matrix_of, mesh_arrays, open_3mf, unit_of

__all__ = ["read_3mf", "write_3mf"]


def write_3mf(path: Path, pieces: Iterable[Piece], title: str = "meshjig puzzle") -> None:
    """Write pieces as one 3MF, each an object of its own in its assembled position, mm.

    Colours are base materials of the core specification, one a piece, since every reader knows those.
    The texture of a scan, or its colours at the corners of triangles, are those of the materials extension.
    Equal pieces give equal bytes: the identifiers of the production extension are drawn from what they name.

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
        looks = LooksOf3mf(wrapper, model)
        identity, whole = wrapper.GetIdentityTransform(), sha256()
        for number, piece in enumerate(pieces, 1):
            mesh = model.AddMeshObject()
            mesh.SetName(piece.name)
            mesh.SetPartNumber(str(number))
            told = _set_geometry(wrapper, mesh, piece)
            red, green, blue = (round(255 * channel) for channel in piece.colour)
            material = materials.AddMaterial(piece.name, wrapper.RGBAToColor(red, green, blue, 255))
            mesh.SetObjectLevelProperty(materials.GetResourceID(), material)
            if piece.texture is not None:
                looks.set(mesh, piece.texture)
            mesh.SetUUID(_uuid("object", piece.name, str(number), told))
            model.AddBuildItem(mesh, identity).SetUUID(_uuid("item", piece.name, str(number), told))
            whole.update(told.encode())
        model.SetBuildUUID(_uuid("build", title, whole.hexdigest()))
        model.QueryWriter("3mf").WriteToFile(str(path))
    except lib3mf.ELib3MFException as error:
        raise OutputError(f"{path.name} can't be written: {error}") from error


def _uuid(*words: str) -> str:
    """Give an identifier that is equal for equal words only."""
    return str(UUID(bytes=sha256("\0".join(words).encode()).digest()[:16], version=4))


def _set_geometry(wrapper: Any, mesh: Any, piece: Piece) -> str:
    """Hand over whole buffers: the binding's own SetGeometry copies every vertex through Python.

    Give a digest of them.
    """
    import lib3mf

    V = np.array(piece.V, np.float32, order="C")
    F = np.array(piece.F, np.uint32, order="C")
    vertices = (lib3mf.Position * len(V)).from_buffer(V)
    triangles = (lib3mf.Triangle * len(F)).from_buffer(F)
    status = wrapper.lib.lib3mf_meshobject_setgeometry(
        mesh._handle, ctypes.c_uint64(len(V)), vertices, ctypes.c_uint64(len(F)), triangles
    )
    wrapper.checkError(mesh, status)
    return sha256(V.tobytes() + F.tobytes()).hexdigest()


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
        unit = unit_of(model).mm
        items = model.GetBuildItems()
        while items.MoveNext():
            item = items.GetCurrent()
            for mesh, placed in _meshes(item.GetObjectResource(), matrix_of(item.GetObjectTransform())):
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
            yield from _meshes(component.GetObjectResource(), matrix_of(component.GetTransform()) @ placed)
