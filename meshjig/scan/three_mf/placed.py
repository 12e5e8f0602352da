"""How much a 3MF package places, counted before anything is made of it."""

from __future__ import annotations

import re
import zipfile
from typing import Any

__all__ = ["faces_placed"]


def faces_placed(archive: zipfile.ZipFile) -> tuple[int, int]:
    """Count the faces of all that is built, and how deep objects are nested, before anything is made.

    An object may place others, which come before it, many times.
    """
    faces: dict[tuple[str, bytes], int] = {}
    depth: dict[tuple[str, bytes], int] = {}
    built: list[tuple[str, bytes]] = []
    for name in archive.namelist():
        if not name.lower().endswith(".model"):
            continue
        text = archive.read(name)
        starts = [match.start() for match in _OBJECT.finditer(text)]
        for start, end in zip(starts, [*starts[1:], len(text)], strict=False):
            part = text[start:end]
            placed = [_named(tag[0], name) for tag in _COMPONENT.finditer(part)]
            thing = _named(_TAG.match(part), name, b"id")
            faces[thing] = part.count(b"<triangle ") or sum(faces.get(key, 0) for key in placed)
            depth[thing] = 1 + max((depth.get(key, 0) for key in placed), default=0)
        built += [_named(tag[0], name) for tag in _ITEM.finditer(text)]
    return sum(faces.get(key, 0) for key in built), max(depth.values(), default=0)


def _named(tag: Any, file: str, word: bytes = b"objectid") -> tuple[str, bytes]:
    """The file and the number of the object that a tag is, or is of."""
    text = tag if isinstance(tag, bytes) else tag[0] if tag else b""
    number = re.search(rb"\b" + word + rb'\s*=\s*["\'](\d+)', text)
    path = re.search(rb"\bpath\s*=\s*[\"']/?([^\"']*)", text)
    return path[1].decode("utf-8", "replace") if path else file, number[1] if number else b""


_TAG = re.compile(rb"<[^>]*>")
_OBJECT = re.compile(rb"<(?:\w+:)?object\b")
_COMPONENT = re.compile(rb"<(?:\w+:)?component\b[^>]*>")
_ITEM = re.compile(rb"<(?:\w+:)?item\b[^>]*>")
