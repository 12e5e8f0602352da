"""3MF by lib3mf: one named and coloured object a piece."""

import ctypes
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import OutputError
from meshjig.output.piece import Piece
from meshjig.output.texture import Coat

__all__ = ["write_3mf"]


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
            if piece.coat is not None:
                _set_colours(wrapper, model, mesh, piece.coat)
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


def _set_colours(wrapper: Any, model: Any, mesh: Any, coat: Coat) -> None:
    """Give the corners of a mesh their colours, rounded to 32 steps a channel: a group holds each once."""
    import lib3mf

    steps = np.rint(31 * coat.rgb.reshape(-1, 3)).astype(np.int64)
    distinct, number = np.unique(steps @ np.array([1024, 32, 1]), return_inverse=True)
    group = model.AddColorGroup()
    channels = np.rint(np.stack([distinct // 1024, distinct // 32 % 32, distinct % 32], 1) * 255 / 31)
    ids = np.array([group.AddColor(wrapper.RGBAToColor(*map(int, rgb), 255)) for rgb in channels], np.uint32)
    rows = np.empty((len(coat.rgb), 4), np.uint32)
    rows[:, 0] = group.GetResourceID()
    rows[:, 1:] = ids[number].reshape(-1, 3)
    properties = (lib3mf.TriangleProperties * len(rows)).from_buffer(rows)
    status = wrapper.lib.lib3mf_meshobject_setalltriangleproperties(
        mesh._handle, ctypes.c_uint64(len(rows)), properties
    )
    wrapper.checkError(mesh, status)
