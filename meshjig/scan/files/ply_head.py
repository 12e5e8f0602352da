"""Heads of PLY files: which elements follow, and which properties each has."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import NamedTuple

__all__ = ["Element", "Head", "Property", "parse_head"]

TYPES = {
    **dict.fromkeys(["char", "int8"], "i1"),
    **dict.fromkeys(["uchar", "uint8"], "u1"),
    **dict.fromkeys(["short", "int16"], "i2"),
    **dict.fromkeys(["ushort", "uint16"], "u2"),
    **dict.fromkeys(["int", "int32"], "i4"),
    **dict.fromkeys(["uint", "uint32"], "u4"),
    **dict.fromkeys(["int64", "long"], "i8"),
    **dict.fromkeys(["uint64", "ulong"], "u8"),
    **dict.fromkeys(["float", "float32"], "f4"),
    **dict.fromkeys(["double", "float64"], "f8"),
}
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


class Property(NamedTuple):
    """A property of an element."""

    name: str  # in small letters
    kind: str  # its type, as NumPy has it: "f4"
    count_kind: str | None  # of the number that a list begins with; None for what is no list


@dataclass(frozen=True)
class Element:
    """A table in a file."""

    name: str
    count: int
    properties: list[Property]


class Head(NamedTuple):
    """What the head of a file says."""

    order: str  # of bytes: "<", ">"; "" for text
    elements: list[Element]
    pictures: list[str]  # files that it names
    size: int  # bytes of the head


def parse_head(data: bytes) -> Head | None:
    """Read the head of a PLY file; None where it has none that makes sense.

    Parameters
    ----------
    data : bytes, without a byte-order mark
    """
    end = re.search(rb"[\r\n]end_header[ \t]*(\r\n|\n|\r|$)", data[: 1 << 20])
    if end is None or not re.match(rb"ply[ \t]*[\r\n]", data):
        return None
    order, elements, pictures = None, [], []
    for line in data[: end.start()].decode("utf-8", "replace").splitlines():
        words = line.split()
        if words[:1] == ["format"]:
            order = _ORDERS.get(words[1] if len(words) > 1 else "")
        elif words[:2] == ["comment", "TextureFile"] or words[:2] == ["comment", "texture_file"]:
            pictures.append(line.strip().split(None, 2)[-1])
        elif words[:1] == ["element"] and len(words) == 3 and words[2].isdecimal():
            elements.append(Element(words[1], int(words[2][:18]), []))
        elif words[:1] == ["property"]:
            found = _property(words)
            if found is None or not elements:
                return None
            elements[-1].properties.append(found)
    return None if order is None else Head(order, elements, pictures, end.end())


def _property(words: list[str]) -> Property | None:
    if len(words) == 5 and words[1] == "list" and {words[2], words[3]} <= TYPES.keys():
        return Property(words[4].lower(), TYPES[words[3]], TYPES[words[2]])
    if len(words) == 3 and words[1] in TYPES:
        return Property(words[2].lower(), TYPES[words[1]], None)
    return None
