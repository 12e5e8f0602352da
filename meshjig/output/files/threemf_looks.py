"""What the triangles of a 3MF show beside their piece's material: a texture, or colours at corners."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.output.scan_picture import Picture
from meshjig.output.texture import Texture

__all__ = ["LooksOf3mf"]

_PATH = "/3D/Textures/picture_{}.png"
_RELATION = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture"
_MOST_COLOURS = 2**16  # of a piece: each is a line of text; beyond, channels are rounded
_STEPS = (256, 128, 64, 32)  # of a channel
_PLACES = 2**16  # steps along a side of the picture


class LooksOf3mf:
    """Sets what meshes of a model show; a picture that they share is written once.

    Parameters
    ----------
    wrapper : lib3mf.Wrapper
    model : lib3mf.Model
    """

    def __init__(self, wrapper: Any, model: Any) -> None:
        self._wrapper, self._model = wrapper, model
        self._textures: dict[int, Any] = {}

    def set(self, mesh: Any, texture: Texture) -> None:
        """Give the corners of a lib3mf.MeshObject their places in the picture, or their colours."""
        if texture.picture is not None and texture.uv is not None:
            group, ids = self._places(texture.picture, texture.uv.reshape(-1, 2))
        else:
            group, ids = self._colours(texture.rgb.reshape(-1, 3))
        import lib3mf

        rows = np.empty((len(texture.rgb), 4), np.uint32)
        rows[:, 0] = group.GetResourceID()
        rows[:, 1:] = ids.reshape(-1, 3)
        properties = (lib3mf.TriangleProperties * len(rows)).from_buffer(rows)
        status = self._wrapper.lib.lib3mf_meshobject_setalltriangleproperties(
            mesh._handle, ctypes.c_uint64(len(rows)), properties
        )
        self._wrapper.checkError(mesh, status)

    def _colours(self, rgb: Floats) -> tuple[Any, Ints]:
        """A group that holds each colour once, and the numbers of those at corners."""
        for steps in _STEPS:
            level = np.rint(rgb * (steps - 1)).astype(np.int64)
            distinct, number = np.unique(level @ np.array([2**16, 2**8, 1]), return_inverse=True)
            if len(distinct) <= _MOST_COLOURS:
                break
        channels = np.stack([distinct >> 16, distinct >> 8 & 255, distinct & 255], 1) * (255 / (steps - 1))
        group = self._model.AddColorGroup()
        make = self._wrapper.RGBAToColor
        rows = np.rint(channels).astype(int).tolist()
        ids = np.array([group.AddColor(make(*row, 255)) for row in rows], np.int64)
        return group, ids[number]

    def _places(self, picture: Picture, uv: Floats) -> tuple[Any, Ints]:
        """A group that holds each place in the picture once, and the numbers of those at corners."""
        import lib3mf

        u, v = np.rint(uv * _PLACES).astype(np.int64).T
        distinct, number = np.unique(u << 32 | v, return_inverse=True)
        group = self._model.AddTexture2DGroup(self._texture(picture))
        add, place, found = self._wrapper.lib.lib3mf_texture2dgroup_addtex2coord, lib3mf.Tex2Coord(), []
        for code in distinct.tolist():
            place.U, place.V = (code >> 32) / _PLACES, (code & 0xFFFFFFFF) / _PLACES
            given = ctypes.c_uint32()
            self._wrapper.checkError(group, add(group._handle, place, given))
            found.append(given.value)
        return group, np.array(found, np.int64)[number]

    def _texture(self, picture: Picture) -> Any:
        import lib3mf

        if id(picture) not in self._textures:
            data = bytearray(picture.png)
            attachment = self._model.AddAttachment(_PATH.format(len(self._textures) + 1), _RELATION)
            buffer = (ctypes.c_uint8 * len(data)).from_buffer(data)
            read = self._wrapper.lib.lib3mf_attachment_readfrombuffer
            status = read(attachment._handle, ctypes.c_uint64(len(data)), buffer)
            self._wrapper.checkError(attachment, status)
            texture = self._model.AddTexture2DFromAttachment(attachment)
            texture.SetContentType(lib3mf.TextureType.PNG)
            texture.SetTileStyleUV(lib3mf.TextureTileStyle.Clamp, lib3mf.TextureTileStyle.Clamp)
            self._textures[id(picture)] = texture
        return self._textures[id(picture)]
