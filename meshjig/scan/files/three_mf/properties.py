"""What the triangles of a 3MF mesh show: colours, materials and mixtures of them, textures."""

from __future__ import annotations

import ctypes
import zipfile
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats, Ints
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.looks import together
from meshjig.scan.files.three_mf.package import whole_buffer
from meshjig.scan.source import Look
from meshjig.scan.wrapping import Wrap, wrapped

__all__ = ["Properties"]

_WRAPS: tuple[Wrap, Wrap, Wrap, Wrap] = ("repeat", "mirror", "clamp", "clamp")  # by lib3mf's number
_BLENDED = "parts with several layers of colours show the uppermost only"
Pixels = NDArray[np.uint8]


class _Group(NamedTuple):
    """A group of properties: what each of its numbers shows."""

    ids: Ints  # (k,), ascending
    values: Floats  # (k, 3) sRGB, 0 to 255; (k, 2) places where there is a picture
    picture: Pixels | None = None

    def at(self, ids: Ints) -> Floats:
        """Give the values of properties, (..., 3) or (..., 2); the first for those that it does not have."""
        place = np.minimum(np.searchsorted(self.ids, ids), len(self.ids) - 1)
        return self.values[np.where(self.ids[place] == ids, place, 0)]


class Properties:
    """The properties of a 3MF model; each group is read once.

    Parameters
    ----------
    model : lib3mf.Model
    archive : zipfile.ZipFile, of which pictures are read
    pictures : PictureReader
    notes : list of str, to which sentences are added of what can't be kept
    """

    def __init__(
        self, model: Any, archive: zipfile.ZipFile, pictures: PictureReader, notes: list[str]
    ) -> None:
        self._model, self._archive, self._pictures, self._notes = model, archive, pictures, notes
        self._groups: dict[int, _Group | None] = {}
        self._images: dict[str, Pixels | None] = {}

    def look(self, mesh: Any, n_faces: int) -> Look:
        """Give what the corners of a lib3mf.MeshObject's triangles show."""
        import lib3mf

        fetch = mesh._wrapper.lib.lib3mf_meshobject_getalltriangleproperties
        rows = whole_buffer(mesh, fetch, lib3mf.TriangleProperties, n_faces).astype(np.int64)
        resource, number, given = mesh.GetObjectLevelProperty()
        if given:
            rows[rows[:, 0] == 0] = resource, number, number, number
        groups = []
        for used in np.unique(rows[:, 0]).tolist():
            faces = np.flatnonzero(rows[:, 0] == used)
            groups.append((faces, self._shown(self._group(used) if used else None, rows[faces, 1:])))
        return together(groups)

    def _shown(self, group: _Group | None, ids: Ints) -> Look:
        if group is None:
            return Look()
        values = group.at(ids)
        if group.picture is not None:
            return Look(uv=values, picture=group.picture)
        return Look(np.rint(values).astype(np.uint8))

    def _group(self, resource: int) -> _Group | None:
        if resource not in self._groups:
            self._groups[resource] = None  # of a group made of itself
            found = self._read(resource)
            self._groups[resource] = found if found is not None and len(found.ids) else None
        return self._groups[resource]

    def _read(self, resource: int) -> _Group | None:
        import lib3mf

        kinds, model = lib3mf.PropertyType, self._model
        kind = model.GetPropertyTypeByID(resource)
        if kind == kinds.Colors:
            group = model.GetColorGroupByID(resource)
            fetch = group._wrapper.lib.lib3mf_colorgroup_getcolor
            return _Group(*_each(group, fetch, lib3mf.Color, _channels))
        if kind == kinds.BaseMaterial:
            group = model.GetBaseMaterialGroupByID(resource)
            fetch = group._wrapper.lib.lib3mf_basematerialgroup_getdisplaycolor
            return _Group(*_each(group, fetch, lib3mf.Color, _channels))
        if kind == kinds.TexCoord:
            return self._textured(model.GetTexture2DGroupByID(resource))
        if kind == kinds.Composite:
            return self._composite(model.GetCompositeMaterialsByID(resource))
        if kind == kinds.Multi:
            return self._layered(model.GetMultiPropertyGroupByID(resource))
        return None

    def _textured(self, group: Any) -> _Group | None:
        import lib3mf

        texture = group.GetTexture2D()
        picture = self._picture(str(texture.GetAttachment().GetPath()))
        if picture is None:
            return None
        fetch = group._wrapper.lib.lib3mf_texture2dgroup_gettex2coord
        ids, uv = _each(group, fetch, lib3mf.Tex2Coord, lambda place: (place.U, place.V))
        across, up = (_WRAPS[int(style)] for style in texture.GetTileStyleUV())
        return _Group(ids, wrapped(uv, (across, up)), picture)

    def _picture(self, path: str) -> Pixels | None:
        if path not in self._images:
            try:
                data = self._archive.read(path.lstrip("/"))
            except (KeyError, OSError, RuntimeError, ValueError, zipfile.BadZipFile):
                self._note(f"the picture {path} is missing: it is left out")
                data = None
            self._images[path] = None if data is None else self._pictures.pixels(data, path)
        return self._images[path]

    def _composite(self, group: Any) -> _Group | None:
        """Mixtures of the colours of base materials."""
        base = self._group(group.GetBaseMaterialGroup().GetResourceID())
        if base is None:
            return None
        ids = np.sort(np.array(group.GetAllPropertyIDs(), np.int64))
        values = np.full((len(ids), 3), 255.0)
        for row, number in enumerate(ids.tolist()):
            mixed = group.GetComposite(number)
            share = np.array([part.MixingRatio for part in mixed])
            if share.sum() > 0:
                colours = base.at(np.array([part.PropertyID for part in mixed]))
                values[row] = share @ colours / share.sum()
        return _Group(ids, values)

    def _layered(self, group: Any) -> _Group | None:
        """The uppermost layer that shows something, which is most often the only one but for the material."""
        import lib3mf

        layers = [group.GetLayer(k).ResourceID for k in range(group.GetLayerCount())]
        kinds = [self._model.GetPropertyTypeByID(layer) for layer in layers]
        materials = (lib3mf.PropertyType.BaseMaterial, lib3mf.PropertyType.Composite)
        above = [k for k, kind in enumerate(kinds) if kind not in materials]
        if len(above) > 1:
            self._note(_BLENDED)
        top = max(above, default=len(layers) - 1)
        shown = self._group(layers[top]) if layers else None
        if shown is None:
            return None
        ids = np.sort(np.array(group.GetAllPropertyIDs(), np.int64))
        below = np.array([_layers(group, number, len(layers))[top] for number in ids.tolist()], np.int64)
        return shown._replace(ids=ids, values=shown.at(below))

    def _note(self, sentence: str) -> None:
        if sentence not in self._notes:
            self._notes.append(sentence)


def _layers(group: Any, number: int, n_layers: int) -> list[int]:
    """What a property shows in each layer, 0 for none; the binding's own getter gives too small a buffer."""
    buffer, needed = (ctypes.c_uint32 * n_layers)(), ctypes.c_uint64(0)
    fetch = group._wrapper.lib.lib3mf_multipropertygroup_getmultiproperty
    status = fetch(group._handle, ctypes.c_uint32(number), ctypes.c_uint64(n_layers), needed, buffer)
    group._wrapper.checkError(group, status)
    return list(buffer)


def _channels(colour: Any) -> tuple[int, int, int]:
    return colour.Red, colour.Green, colour.Blue


def _each(group: Any, fetch: Any, kind: Any, values_of: Any) -> tuple[Ints, Floats]:
    """The numbers of a group's properties, ascending, and what each is."""
    ids = np.sort(np.array(group.GetAllPropertyIDs(), np.int64))
    held, handle = kind(), group._handle
    found = []
    for number in ids.tolist():
        group._wrapper.checkError(group, fetch(handle, ctypes.c_uint32(number), held))
        found.append(values_of(held))
    return ids, np.array(found, np.float64).reshape(len(ids), -1)
