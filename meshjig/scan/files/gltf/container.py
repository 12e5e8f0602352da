"""The parts of a glTF file: its JSON, and the bytes of its buffers, from wherever they are."""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import unquote_to_bytes

from meshjig.errors import InputError
from meshjig.scan.files.beside import read_beside

__all__ = ["Container", "Item", "open_gltf"]

Item = Mapping[str, Any]  # an object of the JSON

_MESHOPT = "EXT_meshopt_compression", "KHR_meshopt_compression"
_READ = {
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
}
_WITHOUT_SHAPE = {  # these change neither shape nor base colour
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_animation_pointer",
    "KHR_lights_punctual",
    "KHR_xmp_json_ld",
}
_HOW = {
    **dict.fromkeys(_MESHOPT, "export it without meshopt compression (gltfpack without -c and -cc)"),
    "KHR_texture_basisu": "export it with PNG or JPEG textures in place of KTX2",
}


@dataclass(frozen=True)
class Container:
    """A glTF file, opened; what its JSON holds may still be wrong."""

    path: Path
    header: Item
    binary: bytes  # the GLB's own buffer
    buffers: dict[int, bytes] = field(default_factory=dict)  # those read so far

    def items(self, kind: str) -> list[Any]:
        """Give what the file has of a kind: "nodes", "meshes" ..."""
        found = self.header.get(kind, [])
        if not isinstance(found, list):
            raise ValueError(f"'{kind}' is no list")
        return found

    def item(self, kind: str, number: Any) -> Item:
        """Give one thing of a kind by its number.

        Raises
        ------
        ValueError
            The file does not have it.
        """
        found = self.items(kind)
        if not isinstance(number, int) or isinstance(number, bool) or not 0 <= number < len(found):
            raise ValueError(f"there is no number {number!r} among its {kind}")
        if not isinstance(found[number], dict):
            raise ValueError(f"number {number} of its {kind} is no object")
        return dict(found[number])

    def view(self, number: Any) -> memoryview:
        """Give the bytes of a buffer view.

        Raises
        ------
        InputError
            The file that holds them is missing or no regular file.
        ValueError
            They are not there.
        """
        view = self.item("bufferViews", number)
        start, length = int(view.get("byteOffset", 0)), int(view["byteLength"])
        data = self._buffer(view["buffer"])
        if start < 0 or length < 0 or start + length > len(data):
            for name in set(_MESHOPT) & set(view.get("extensions", {})):
                raise InputError(f"{self.path} needs {name}", hint=_HOW[name])
            raise ValueError(f"a view of {length} bytes ends beyond its buffer of {len(data)}")
        return memoryview(data)[start : start + length]

    def uri(self, uri: Any, what: str) -> bytes | None:
        """Give the bytes that a URI stands for; None where that file is missing."""
        if not isinstance(uri, str):
            raise ValueError(f"the URI of {what} is no text")
        if uri[:5].lower() != "data:":
            return read_beside(self.path, uri)
        head, comma, body = uri.partition(",")
        if not comma:
            raise ValueError(f"the data URI of {what} is damaged")
        raw = unquote_to_bytes(body)
        return base64.b64decode(raw + b"=" * (-len(raw) % 4)) if head.lower().endswith(";base64") else raw

    def _buffer(self, number: Any) -> bytes:
        if number not in self.buffers:
            buffer = self.item("buffers", number)
            if "uri" in buffer:
                data = self.uri(buffer["uri"], "a buffer")
                if data is None:
                    raise InputError(
                        f"{self.path} needs {buffer['uri']}, which is not beside it",
                        hint="put that file into the same folder, or export as GLB, which is one file",
                    )
            else:
                data = self.binary if number == 0 else b""
            self.buffers[number] = data
        return self.buffers[number]


def open_gltf(path: Path) -> Container:
    """Open a glTF or GLB file, told by its bytes.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Container

    Raises
    ------
    InputError
        It is of version 1, or requires an extension that is not known here.
    ValueError
        It is damaged.
    """
    data = path.read_bytes()
    text, binary = data, b""
    if data[:4] == b"glTF":
        (version,) = struct.unpack_from("<I", data, 4)
        if version != 2:
            raise InputError(f"{path} is GLB of version {version}", hint="export it as glTF 2.0")
        chunks = _chunks(data)
        text, binary = chunks.get(b"JSON", b""), chunks.get(b"BIN\0", b"")
    header = json.loads(text.decode("utf-8-sig"))
    if not isinstance(header, dict):
        raise ValueError("its JSON is no object")
    version = str(header.get("asset", {}).get("version", "2.0"))
    if version.split(".")[0] != "2":
        raise InputError(f"{path} is glTF of version {version[:10]}", hint="export it as glTF 2.0")
    for name in header.get("extensionsRequired", []):
        if name not in _READ | _WITHOUT_SHAPE:
            how = _HOW.get(name, "export it without that extension")
            raise InputError(f"{path} needs {name}, an extension that meshjig does not know", hint=how)
    return Container(path, header, binary)


def _chunks(data: bytes) -> dict[bytes, bytes]:
    """The chunks of a GLB by their kind, the first of each."""
    found: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= len(data):
        length, kind = struct.unpack_from("<I4s", data, at)
        found.setdefault(kind, data[at + 8 : at + 8 + length])
        at += 8 + length
    return found
