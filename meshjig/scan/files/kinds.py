"""Which kind of file bytes are: a name is a promise, bytes tell."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

from meshjig.errors import InputError
from meshjig.scan.files.formats import FORMATS
from meshjig.scan.files.stl import is_text_stl, size_fits
from meshjig.scan.files.words import plain

__all__ = ["check_kind"]

_HEAD = 4096  # bytes that tell
_PICTURE = "give the mesh, not a picture of it"
_EXPORT = f"export it as one of {', '.join(sorted(FORMATS))}"
_UNPACK = "unpack it, and give the mesh inside"
_MAGIC = [
    (b"\x89PNG\r\n", "a PNG picture", _PICTURE),
    (b"\xff\xd8\xff", "a JPEG picture", _PICTURE),
    (b"GIF8", "a GIF picture", _PICTURE),
    (b"II*\0", "a TIFF picture", _PICTURE),
    (b"MM\0*", "a TIFF picture", _PICTURE),
    (b"%PDF-", "a PDF document", "give the mesh itself"),
    (b"\x1f\x8b\x08", "a gzip archive", _UNPACK),
    (b"BZh", "a bzip2 archive", _UNPACK),
    (b"\xfd7zXZ", "an xz archive", _UNPACK),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive", _UNPACK),
    (b"Rar!", "a RAR archive", _UNPACK),
    (b"Kaydara FBX Binary", "an FBX model", _EXPORT),
    (b"; FBX", "an FBX model", _EXPORT),
    (b"BLENDER", "a Blender project", _EXPORT),
    (b"ISO-10303-21", "a STEP model", _EXPORT),
    (b"PXR-USDC", "a USD model", _EXPORT),
    (b"#usda", "a USD model", _EXPORT),
    (b"version https://git-lfs", "a pointer of Git LFS in place of the file", "fetch it with 'git lfs pull'"),
    (b"\x7fELF", "a program", "give a mesh"),
]
_ROOTS = [
    (r"<(!doctype\s+)?html", "a web page", "download the file itself"),
    (r"<(\w+:)?collada", "a COLLADA model", _EXPORT),
    (r"<(\w+:)?amf\b", "an AMF model", _EXPORT),
    (r"<(\w+:)?x3d\b", "an X3D model", _EXPORT),
    (r"<(\w+:)?svg\b", "an SVG drawing", "give a mesh"),
    (r"^\s*<\?xml", "an XML document", _EXPORT),
]
_OBJ_LINE = re.compile(
    rb"(v|vt|vn)(\s+[-+]?[\d.]+([eE][-+]?\d+)?){2,}\s*$|(mtllib|usemtl)\s+\S|f(\s+-?\d+(/-?\d*){0,2}){3,}\s*$"
)


def check_kind(path: Path, kind: str) -> None:
    """Refuse a file whose format is not known, or whose bytes are those of another kind.

    Parameters
    ----------
    path : Path
    kind : str, its extension in small letters

    Raises
    ------
    InputError
    """
    with path.open("rb") as file:
        head = file.read(_HEAD)
    mesh = _mesh_kind(path, head)
    if kind in FORMATS and (mesh == kind or (kind == "stl" and size_fits(path, head))):
        return
    is_no = f"{path} is no {kind.upper()} file" if kind in FORMATS else _unknown(path, kind)
    if mesh:
        named = f"{path.stem}.{mesh}" if kind else f"{path.name}.{mesh}"
        raise InputError(f"{is_no}: its bytes are those of {mesh.upper()}", hint=f"rename it to {named}")
    other = _other_kind(head)
    if other:
        raise InputError(f"{is_no}: it holds {other[0]}", hint=other[1])
    if kind not in FORMATS:
        raise InputError(is_no, hint=f"it reads {', '.join(sorted(FORMATS))}")


def _unknown(path: Path, kind: str) -> str:
    shown = f"{path} is a .{kind} file" if kind else f"{path} has no file extension"
    return f"{shown}, a format that meshjig does not know"


def _mesh_kind(path: Path, head: bytes) -> str:
    """The format of a mesh, where bytes tell it plainly; else nothing."""
    if head[:4] == b"glTF":
        return "glb"
    if head[:4] == b"PK\x03\x04":
        return "3mf" if _is_3mf(path) else ""
    text = plain(head)
    if re.match(rb"ply[ \t]*\n", text):
        return "ply"
    if b"\0" in text:
        return "stl" if size_fits(path, head) else ""
    if re.match(rb"\s*(#[^\n]*\n\s*)*(ST)?C?N?4?n?OFF\b", text):
        return "off"
    if is_text_stl(head) and b"facet" in text.lower():
        return "stl"
    if re.match(rb"\s*\{", text) and re.search(rb'"(asset|accessors|bufferViews)"\s*:', text):
        return "gltf"
    lines = [line for line in text.split(b"\n")[:-2] if line.strip() and line.lstrip()[:1] != b"#"][:50]
    return "obj" if sum(bool(_OBJ_LINE.match(line.strip())) for line in lines) > len(lines) / 2 else ""


def _is_3mf(path: Path) -> bool:
    try:
        with zipfile.ZipFile(path) as archive:
            return any(name.lower().endswith(".model") for name in archive.namelist())
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
        return path.suffix.lower() == ".3mf"  # its reader says what is wrong


def _other_kind(head: bytes) -> tuple[str, str] | None:
    """What is no mesh that is read here, and what to do about it."""
    for magic, name, hint in _MAGIC:
        if head.startswith(magic):
            return name, hint
    if head[:4] == b"RIFF" and head[8:12] == b"WEBP":
        return "a WEBP picture", _PICTURE
    if head[:4] == b"PK\x03\x04":
        return "a ZIP archive", _UNPACK
    text = plain(head).decode("utf-8", "replace").lower()
    if text.lstrip().startswith("<"):
        for root, name, hint in _ROOTS:
            if re.search(root, text):
                return name, hint
    return None
