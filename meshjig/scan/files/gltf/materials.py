"""What a glTF primitive shows: its base colour, a picture, colours at its vertices."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.gltf.container import Container, Item
from meshjig.scan.files.gltf.primitives import Primitive
from meshjig.scan.source import Look
from meshjig.scan.wrapping import Wrap, wrapped

__all__ = ["Materials"]

_WHITE = np.ones(3)
_WRAPS: Mapping[Any, Wrap] = {33071: "clamp", 33648: "mirror"}
_SCREEN = (
    "trimesh",
)  # programs that write colours as a screen shows them, where the standard has linear ones
Pixels = NDArray[np.uint8]


class _Base(NamedTuple):
    """The base colour of a material."""

    factor: Floats  # (3,), linear unless the program says otherwise
    texture: Item | None  # a textureInfo
    coloured: bool  # whether the file says a colour


class Materials:
    """The materials of a glTF file; its pictures are read when they are first asked for.

    Parameters
    ----------
    file : Container
    pictures : PictureReader
    notes : list of str, to which sentences are added of what can't be kept
    """

    def __init__(self, file: Container, pictures: PictureReader, notes: list[str]) -> None:
        self._file, self._pictures, self._notes = file, pictures, notes
        generator = str(file.header.get("asset", {}).get("generator", "")).lower()
        self._linear = not any(program in generator for program in _SCREEN)
        self._images: dict[Any, Pixels | None] = {}
        self._tinted: dict[tuple[Any, bytes], Pixels] = {}

    def attributes(self, primitive: Item) -> set[str]:
        """Name the attributes that `look` wants."""
        texture = self._base(primitive).texture
        return {"COLOR_0"} | ({f"TEXCOORD_{_uv_set(texture)}"} if texture is not None else {"TEXCOORD_0"})

    def look(self, primitive: Item, mesh: Primitive) -> Look:
        """Give what the corners of the faces show.

        A picture is multiplied by the base colour; so are colours of vertices. Where both a picture and
        several colours are given, the picture stays, and a note says so.
        """
        base = self._base(primitive)
        colours = mesh.attributes.get("COLOR_0")
        if colours is not None:
            colours = colours[:, :3]
            if (colours == colours[:1]).all() and len(colours):
                base = base._replace(factor=base.factor * colours[0], coloured=True)
                colours = None
        name = "TEXCOORD_0" if base.texture is None else f"TEXCOORD_{_uv_set(base.texture)}"
        uv = mesh.attributes.get(name)
        picture = None
        if uv is not None and uv.shape[1] != 2:
            raise ValueError(f"{name} has {uv.shape[1]} numbers a vertex")
        if base.texture is not None and uv is None:
            self._note("a part that has a texture does not say where in it its faces are: it stays plain")
        elif base.texture is not None:
            picture = self._picture(base.texture["index"])
        if uv is not None:
            moved = uv if base.texture is None else _transformed(uv, base.texture)
            uv = self._placed(moved, base.texture, mesh)
        if picture is not None and colours is not None:
            if (picture == picture[:1, :1]).all():
                base = base._replace(factor=base.factor * self._as_linear(picture[0, 0] / 255.0))
                picture = None
            else:
                self._note(
                    "colours at the vertices of a part with a texture are left out: the texture is kept"
                )
        if picture is not None:
            return Look(uv=uv, picture=self._times(base, picture))
        if colours is not None:
            rgb = self._screen(colours * base.factor)
            return Look(rgb[mesh.F], uv)
        if base.coloured:
            return Look(np.broadcast_to(self._screen(base.factor), (len(mesh.F), 3, 3)).copy(), uv)
        return Look(uv=uv)

    def _base(self, primitive: Item) -> _Base:
        if "material" not in primitive:
            return _Base(_WHITE, None, False)
        material = self._file.item("materials", primitive["material"])
        pbr = material.get("pbrMetallicRoughness", {})
        factor, texture = pbr.get("baseColorFactor"), pbr.get("baseColorTexture")
        other = material.get("extensions", {}).get("KHR_materials_pbrSpecularGlossiness")
        if other is not None and texture is None:
            factor, texture = other.get("diffuseFactor", factor), other.get("diffuseTexture")
        if texture is None and "emissiveTexture" in material:  # of a scan that is to be seen as it was lit
            factor, texture = None, material["emissiveTexture"]
        colour = _WHITE if factor is None else np.array(factor[:3], np.float64)
        return _Base(colour, texture, factor is not None)

    def _picture(self, texture: Any) -> Pixels | None:
        """The picture of a texture, (height, width, 3); None, and a note, where it can't be had."""
        found = self._file.item("textures", texture)
        webp = found.get("extensions", {}).get("EXT_texture_webp", {}).get("source")
        number = found.get("source", webp) if webp is None else webp
        if number is None:
            self._note(f"texture {texture} is left out: it is of no kind that is read here")
            return None
        if number not in self._images:
            self._images[number] = self._read(self._file.item("images", number), number)
        return self._images[number]

    def _read(self, image: Item, number: Any) -> Pixels | None:
        if "uri" in image:
            uri = image["uri"]
            name = f"number {number}" if str(uri)[:5].lower() == "data:" else str(uri)
            data = self._file.uri(uri, "a picture")
            if data is None:
                self._note(f"the picture {name} is missing: it is left out")
                return None
        else:
            name, data = (
                str(image.get("name") or f"number {number}"),
                bytes(self._file.view(image["bufferView"])),
            )
        return self._pictures.pixels(data, name)

    def _times(self, base: _Base, picture: Pixels) -> Pixels:
        if np.abs(base.factor - 1).max() < 1e-3:
            return picture
        key = id(picture), base.factor.tobytes()
        if key not in self._tinted:
            levels = self._as_linear(np.arange(256) / 255.0)
            table = self._screen(levels[:, None] * base.factor)
            self._tinted[key] = np.stack([table[picture[..., k], k] for k in range(3)], axis=-1)
        return self._tinted[key]

    def _placed(self, uv: Floats, texture: Item | None, mesh: Primitive) -> Floats:
        """Places at corners (m, 3, 2), v upward; what is clamped or mirrored is brought into the picture."""
        at_corners = uv[mesh.F]
        if texture is not None:
            number = self._file.item("textures", texture["index"]).get("sampler")
            sampler = {} if number is None else self._file.item("samplers", number)
            across, down = (_WRAPS.get(sampler.get(name), "repeat") for name in ("wrapS", "wrapT"))
            at_corners = wrapped(at_corners, (across, down))
        return at_corners * (1, -1) + (0, 1)

    def _screen(self, colour: Floats) -> Pixels:
        """Bytes, as a screen shows them, of colours as the file has them."""
        c = np.clip(np.nan_to_num(colour), 0, 1)
        if self._linear:
            c = np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)
        return np.rint(255 * c).astype(np.uint8)

    def _as_linear(self, colour: Floats) -> Floats:
        """Colours as the file has them, of those that a screen shows, 0 to 1."""
        if not self._linear:
            return colour
        return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)

    def _note(self, sentence: str) -> None:
        if sentence not in self._notes:
            self._notes.append(sentence)


def _uv_set(texture: Item) -> int:
    moved = texture.get("extensions", {}).get("KHR_texture_transform", {})
    return int(moved.get("texCoord", texture.get("texCoord", 0)))


def _transformed(uv: Floats, texture: Item) -> Floats:
    """Places in the picture, v downward, after a texture's own transform."""
    moved = texture.get("extensions", {}).get("KHR_texture_transform")
    if moved is None:
        return uv
    c, s = np.cos(moved.get("rotation", 0.0)), np.sin(moved.get("rotation", 0.0))
    scaled = uv * np.array(moved.get("scale", (1, 1)), np.float64)
    return scaled @ np.array([[c, -s], [s, c]]) + np.array(moved.get("offset", (0, 0)), np.float64)
