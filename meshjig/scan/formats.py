"""Is a mesh file whole? Readers skip over a missing tail; a user should hear of it first."""

from __future__ import annotations

import json
import re
import struct
import zipfile
from pathlib import Path
from typing import Any

from meshjig.errors import InputError

__all__ = ["FORMATS", "check_whole", "gltf_shortfall", "mentions_faces", "off_shortfall", "ply_shortfall"]


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
    """Refuse a file that ends too early, as far as the format lets one know.

    Parameters
    ----------
    path : Path
    kind : str, one of FORMATS

    Raises
    ------
    InputError
        The file is cut off, or an OBJ file is no text.
    """
    if kind == "obj" and b"\0" in path.read_bytes():
        raise InputError(
            f"{path} is damaged: OBJ is a format of text, and it holds none", hint="export it again"
        )
    look = {
        "stl": _stl,
        "glb": _glb,
        "gltf": gltf_shortfall,
        "3mf": _3mf,
        "obj": _obj,
        "ply": _ply,
        "off": _off,
    }
    missing = look[kind](path)
    if missing:
        raise InputError(f"{path} is cut off: {missing}", hint="copy or export it again")


def mentions_faces(path: Path, kind: str) -> bool:
    """Tell whether an OBJ file has face lines, be they any good or not."""
    return kind == "obj" and re.search(rb"^f\s", path.read_bytes(), re.MULTILINE) is not None


def _stl(path: Path) -> str:
    size = path.stat().st_size
    with path.open("rb") as file:
        head = file.read(84)
        file.seek(max(0, size - 200))
        tail = file.read()
    if head.lstrip()[:5].lower() == b"solid" and b"\0" not in head:
        return "" if b"endsolid" in tail.lower() else "the line 'endsolid' is missing"
    if len(head) < 84:
        return f"it has {size} bytes, and the head of an STL file alone has 84"
    (count,) = struct.unpack("<I", head[80:84])
    if size < 84 + 50 * count:
        return f"it announces {count} triangles and holds {(size - 84) // 50}"
    return ""


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


def _obj(path: Path) -> str:
    """An OBJ file has no end mark: only a last line that is half a vertex or half a face tells."""
    size = path.stat().st_size
    with path.open("rb") as file:
        file.seek(max(0, size - 4096))
        tail = file.read()
    line = tail.rsplit(b"\n", 1)[-1].split(b"#")[0].split()
    if line and line[0] in (b"v", b"f") and len(line) < 4:
        return f"its last line, '{b' '.join(line).decode(errors='replace')}', is not whole"
    return ""


def _ply(path: Path) -> str:
    """Rows of text are counted; of binary PLY, its size is compared."""
    if shortfall := ply_shortfall(path):
        return shortfall
    data = path.read_bytes()
    head, mark, body = data.partition(b"end_header")
    if not head.startswith(b"ply"):
        return ""
    if not mark:
        return "its head does not end"
    if b"format ascii" not in head:
        return ""
    announced = sum(int(n) for n in re.findall(rb"^element\s+\S+\s+(\d+)", head, re.MULTILINE))
    return _too_few(announced, [line for line in body.splitlines() if line.strip()])


def _off(path: Path) -> str:
    lines = [line for line in (x.split(b"#")[0].strip() for x in path.read_bytes().splitlines()) if line]
    match = re.match(rb"[A-Z4n]*OFF\s*(.*)", lines[0]) if lines else None
    if not match or b"BINARY" in lines[0]:
        return ""
    counts = match[1].split() or (lines.pop(1).split() if len(lines) > 1 else [])
    if len(counts) < 2 or not all(count.isdigit() for count in counts):
        return ""
    return off_shortfall(counts, path.stat().st_size) or _too_few(int(counts[0]) + int(counts[1]), lines[1:])


def _too_few(announced: int, rows: list[bytes]) -> str:
    if len(rows) < announced:
        return f"it announces {announced} vertices and faces and holds {len(rows)}"
    last = rows[announced - 1].split() if announced else []
    if last and last[0].isdigit() and len(last) <= int(last[0]) < 20:
        return f"its last face, '{b' '.join(last).decode(errors='replace')}', is not whole"
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
