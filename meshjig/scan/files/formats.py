"""Is a mesh file whole? Readers skip over a missing tail; a user should hear of it first."""

from __future__ import annotations

import json
import re
import struct
import zipfile
from pathlib import Path
from typing import Any

from meshjig.errors import InputError

__all__ = ["FORMATS", "check_whole", "gltf_shortfall", "half_a_face", "off_shortfall", "ply_shortfall"]


FORMATS = frozenset({"stl", "obj", "ply", "off", "glb", "gltf", "3mf"})

_PLY_TYPES = {
    **dict.fromkeys(["char", "uchar", "int8", "uint8"], 1),
    **dict.fromkeys(["short", "ushort", "int16", "uint16"], 2),
    **dict.fromkeys(["int", "uint", "float", "int32", "uint32", "float32"], 4),
    **dict.fromkeys(["double", "float64"], 8),
}
_HEAD = 1 << 20  # bytes; no head of a PLY file is longer
_PACKING = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")  # with these, a byte may hold much


def check_whole(path: Path, kind: str) -> None:
    """Refuse a file that ends too early, as far as the format lets one know before it is read.

    Parameters
    ----------
    path : Path
    kind : str, one of FORMATS

    Raises
    ------
    InputError
        The file is cut off.
    """
    look = {"glb": _glb, "gltf": gltf_shortfall, "3mf": _3mf, "ply": ply_shortfall}
    missing = look[kind](path) if kind in look else ""
    if missing:
        raise InputError(f"{path} is cut off: {missing}", hint="copy or export it again")


def _glb(path: Path) -> str:
    with path.open("rb") as file:
        head = file.read(12)
    if len(head) == 12 and head[:4] == b"glTF":
        (length,) = struct.unpack("<I", head[8:12])
        if path.stat().st_size < length:
            return f"it announces {length} bytes and holds {path.stat().st_size}"
    return gltf_shortfall(path)


def _3mf(path: Path) -> str:
    return "" if zipfile.is_zipfile(path) else "the table at the end of the archive is missing"


def half_a_face(line: str) -> str:
    """Say that the last line of a file of text is no whole list of corners; nothing where it may be."""
    words = line.split()
    if words and words[0].isdecimal() and len(words) <= int(words[0][:4]) < 20:
        return f"its last face, '{' '.join(words)}', is not whole"
    return ""


def ply_shortfall(path: Path) -> str:
    """Say what a PLY file announces and can't hold; nothing where it may."""
    with path.open("rb") as file:
        head, end, _ = file.read(_HEAD).partition(b"end_header")
    if not head.startswith(b"ply") or not end:
        return ""
    is_text = b"format ascii" in head
    room = path.stat().st_size - len(head)
    for element in re.split(rb"^element\s+", head, flags=re.MULTILINE)[1:]:
        words = element.split()
        if len(words) < 2 or not words[1][:18].isdigit():
            continue
        least = sum(
            _least_size(line.decode("ascii", "replace").split(), is_text) for line in element.splitlines()
        )
        room -= int(words[1][:18]) * least
        if room < 0:
            name, count = words[0].decode("ascii", "replace"), int(words[1][:18])
            return (
                f"it announces {count} elements '{name}', more than its {path.stat().st_size} bytes can hold"
            )
    return ""


def off_shortfall(counts: list[bytes], size: int) -> str:
    """Say what an OFF file announces and can't hold: a vertex takes six bytes, a face eight."""
    vertices, faces = int(counts[0][:18]), int(counts[1][:18])
    if 6 * vertices + 8 * faces > size + 16:
        return f"it announces {vertices} vertices and {faces} faces, more than its {size} bytes can hold"
    return ""


def gltf_shortfall(path: Path) -> str:
    """Say what a glTF or GLB file announces and can't hold; nothing where it may.

    An accessor without data stands for zeros, as many as it says; no mesh is made of these alone.
    """
    try:
        header = _gltf_header(path)
        if set(_PACKING) & set(header.get("extensionsUsed", ())):
            return ""
        held = path.stat().st_size + sum(_size_beside(path, buffer) for buffer in header.get("buffers", ()))
        most = max((int(accessor.get("count", 0)) for accessor in header.get("accessors", ())), default=0)
    except (ValueError, TypeError, AttributeError, RecursionError, struct.error):
        return ""  # its reader says what is wrong
    if most > held:
        return f"it announces {most} entries of an array, more than its {held} bytes can hold"
    return ""


def _least_size(words: list[str], is_text: bool) -> int:
    """The bytes that a property of a PLY file takes at least."""
    if len(words) < 3 or words[0] != "property":
        return 0
    return 2 if is_text else _PLY_TYPES.get(words[1] if words[1] != "list" else words[2], 1)


def _gltf_header(path: Path) -> Any:
    if path.suffix.lower() == ".gltf":
        return json.loads(path.read_bytes())
    with path.open("rb") as file:
        (length,) = struct.unpack("<12xI4x", file.read(20))
        return json.loads(file.read(min(length, path.stat().st_size)))


def _size_beside(path: Path, buffer: Any) -> int:
    """The bytes of a buffer in a file of its own."""
    from urllib.parse import unquote

    uri = buffer.get("uri")
    if not uri or uri.startswith("data:"):
        return 0
    try:
        return (path.parent / unquote(uri)).stat().st_size
    except (OSError, ValueError):
        return 0
