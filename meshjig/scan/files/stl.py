"""STL files: text or binary, whatever their first word and their count of triangles say."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import InputError
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.file_mesh import FileMesh
from meshjig.scan.files.surface import surface
from meshjig.scan.files.words import Lines, plain, table
from meshjig.scan.source import Look, Source

__all__ = ["is_text_stl", "read_stl", "size_fits"]

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
_HEAD = 84  # bytes
_UNSET = (0, 2**32 - 1)  # counts that stand where a writer meant to come back to


def is_text_stl(data: bytes) -> bool:
    """Tell whether an STL file is one of text: by its words, as binary ones, too, begin with "solid"."""
    text = plain(data[:4000]).lower()
    return b"\0" not in text and (b"facet" in text or (text.lstrip()[:5] == b"solid" and len(data) < 4000))


def size_fits(path: Path, head: bytes) -> bool:
    """Tell whether a file has the size that a binary STL file with such a head has."""
    return (
        len(head) >= _HEAD
        and path.stat().st_size == _HEAD + _FACET.itemsize * struct.unpack("<I", head[80:_HEAD])[0]
    )


def read_stl(path: Path, pictures: PictureReader) -> FileMesh:
    """Read an STL file.

    Parameters
    ----------
    path : Path
    pictures : PictureReader, which an STL file has no use for

    Returns
    -------
    FileMesh

    Raises
    ------
    InputError
        It is cut off.
    """
    data = path.read_bytes()
    return _of_text(path, data) if is_text_stl(data) else _of_bytes(path, data)


def _of_text(path: Path, data: bytes) -> FileMesh:
    text = plain(data).lower()
    if b"endsolid" not in text[-1000:]:
        raise InputError(f"{path} is cut off: the line 'endsolid' is missing", hint="copy or export it again")
    lines = Lines(text)
    corners = lines.starting(b"vertex")
    rows = lines.only(corners, without=6)
    V = table(rows.floats(), rows.sizes, 3)
    place = np.searchsorted(np.flatnonzero(lines.sizes), corners)
    breaks = np.flatnonzero(np.diff(place, prepend=-2) > 1)  # other lines between corners, whatever they say
    made = surface(V, np.arange(len(V)), np.diff(breaks, append=len(place)))
    announced = max(len(lines.starting(b"facet")), made.found)
    return FileMesh(Source(V, made.F), "meshjig", [], announced, made.found)


def _of_bytes(path: Path, data: bytes) -> FileMesh:
    if len(data) < _HEAD:
        raise InputError(
            f"{path} is cut off: it has {len(data)} bytes, and the head of an STL file alone has {_HEAD}",
            hint="copy or export it again",
        )
    (count,) = struct.unpack("<I", data[80:_HEAD])
    held, left = divmod(len(data) - _HEAD, _FACET.itemsize)
    notes = []
    if held and not left and (count in _UNSET or count < held):
        said = "was never filled in" if count in _UNSET else f"is {count}"
        notes.append(f"its count of triangles {said}; by its size it has {held}, and these were read")
        count = held
    if count > held:
        raise InputError(
            f"{path} is cut off: it announces {count} triangles and holds {held}",
            hint="copy or export it again",
        )
    if count < held:
        notes.append(f"it announces {count} triangles and has room for {held}: what follows them is left out")
    facets = np.frombuffer(data, _FACET, count, _HEAD)
    V = facets["corners"].reshape(-1, 3).astype(np.float64)
    made = surface(V, np.arange(len(V)), np.full(count, 3))
    rgb = _colours(data[:80], facets["more"])
    look = Look() if rgb is None else Look(np.repeat(rgb[made.polygon][:, None], 3, axis=1))
    return FileMesh(Source(V, made.F, look), "meshjig", notes, count, made.found)


def _colours(head: bytes, more: NDArray[np.uint16]) -> NDArray[np.uint8] | None:
    """The colours of facets (m, 3) in the bytes that the format leaves free, where these are plainly such.

    Materialise's Magics writes COLOR= into the head; a bit says of a facet that it has that colour. VisCAM
    and SolidView set this bit where a facet has one of its own, and have red and blue the other way round.
    MeshLab writes COLOR=, and sets the bit everywhere, though facets have their own.
    """
    if not len(more):
        return None
    top, fives = more >> 15 == 1, np.stack([more & 31, more >> 5 & 31, more >> 10 & 31], 1).astype(np.float64)
    levels = np.rint(fives * (255 / 31)).astype(np.uint8)
    at = head.find(b"COLOR=")
    if 0 <= at <= 80 - 10:
        whole = np.frombuffer(head, np.uint8, 3, at + 6)
        shared = top & (not top.all() or (more == more[0]).all())
        return np.where(shared[:, None], whole, levels)
    if not top.any() or (more[~top] != 0).any():
        return None
    return np.where(top[:, None], levels[:, ::-1], np.uint8(255))
