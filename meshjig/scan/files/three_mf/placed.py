"""How much a 3MF package places, counted before anything is made of it."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

__all__ = ["faces_placed"]


Key = tuple[str, bytes]  # a file of the package, and the number of an object in it


def faces_placed(archive: zipfile.ZipFile) -> tuple[int, int]:
    """Count the faces of all that is built, and how deep objects are nested, before anything is made.

    An object may place others many times, of other files of the package too.
    """
    own: dict[Key, int] = {}
    placed: dict[Key, list[Key]] = {}
    built: list[Key] = []
    for name in archive.namelist():
        if not name.lower().endswith(".model"):
            continue
        text = archive.read(name)
        starts = [match.start() for match in _OBJECT.finditer(text)]
        for start, end in zip(starts, [*starts[1:], len(text)], strict=False):
            part = text[start:end]
            thing = _named(_TAG.match(part), name, b"id")
            placed[thing] = [_named(tag[0], name) for tag in _COMPONENT.finditer(part)]
            own[thing] = part.count(b"<triangle ") + part.count(b":triangle ")
        built += [_named(tag[0], name) for tag in _ITEM.finditer(text)]
    faces: dict[Key, int] = {}
    depth: dict[Key, int] = {}
    for thing in _parts_first(placed):
        known = [key for key in placed[thing] if key in faces]
        faces[thing] = own[thing] + sum(faces[key] for key in known)
        depth[thing] = 1 + max((depth[key] for key in known), default=0)
    inner = {key for keys in placed.values() for key in keys}
    shown = built or [key for key in placed if key not in inner]
    return sum(faces.get(key, 0) for key in shown), max(depth.values(), default=0)


def _parts_first(placed: Mapping[Key, Sequence[Key]]) -> Iterator[Key]:
    """Every object after those that it places; where they place each other, in any order."""
    started: set[Key] = set()
    done: set[Key] = set()
    waiting = list(placed)[::-1]
    while waiting:
        thing = waiting[-1]
        if thing not in started:
            started.add(thing)
            waiting += [key for key in placed[thing] if key in placed and key not in started]
            continue
        waiting.pop()
        if thing not in done:
            done.add(thing)
            yield thing


def _named(tag: Any, file: str, word: bytes = b"objectid") -> Key:
    """The file and the number of the object that a tag is, or is of."""
    text = tag if isinstance(tag, bytes) else tag[0] if tag else b""
    number = re.search(rb"\b" + word + rb'\s*=\s*["\'](\d+)', text)
    path = re.search(rb"\bpath\s*=\s*[\"']/?([^\"']*)", text)
    return path[1].decode("utf-8", "replace") if path else file, number[1] if number else b""


_TAG = re.compile(rb"<[^>]*>")
_OBJECT = re.compile(rb"<(?:\w+:)?object\b")
_COMPONENT = re.compile(rb"<(?:\w+:)?component\b[^>]*>")
_ITEM = re.compile(rb"<(?:\w+:)?item\b[^>]*>")
