"""What the faces of an OBJ file show by their materials."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Ints
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.beside import find_beside, read_beside, short
from meshjig.scan.files.looks import together
from meshjig.scan.files.mtl import Material, Picture, parse_mtl
from meshjig.scan.files.surface import levels
from meshjig.scan.files.words import Lines
from meshjig.scan.source import Look

__all__ = ["look_of_materials"]

_NAMED = 3  # names in a note


def look_of_materials(
    path: Path, lines: Lines, pictures: PictureReader, line_of_face: Ints, plain: Look
) -> tuple[Look, list[str]]:
    """Give what faces show, with their materials.

    Parameters
    ----------
    path : Path, of the OBJ file
    lines : Lines, of it
    pictures : PictureReader
    line_of_face : (m,) int64, where each face stands
    plain : Look, what they show without materials

    Returns
    -------
    look : Look
    notes : list of str, a sentence for everything that is missing

    Raises
    ------
    InputError
        A pipe or a device is named.
    """
    uses = lines.starting(b"usemtl")
    names = [lines.rest(int(k)) for k in uses]
    material = np.searchsorted(uses, line_of_face) - 1  # -1: before the first
    used, group = np.unique(material, return_inverse=True)
    known, notes = _library(path, lines)
    by_name: dict[str | None, int] = {}
    wanted = [by_name.setdefault(names[k] if k >= 0 else None, len(by_name)) for k in used]
    group = np.array(wanted, np.int64)[group] if len(used) else group
    lacking = [repr(short(name)) for name in by_name if name is not None and name not in known]
    if lacking and known:
        more = f" and {len(lacking) - _NAMED} more" if len(lacking) > _NAMED else ""
        notes.append(f"no file of materials has {', '.join(lacking[:_NAMED])}{more}: left out")
    if not any(name in known for name in by_name):
        return plain, notes
    chosen = [known.get(name or "", Material()) for name in by_name]
    pictures.expected = len({(one.picture.named_by, one.picture.name) for one in chosen if one.picture})
    shelf = _Shelf(path, pictures)
    groups = []
    for k, one in enumerate(chosen):
        some = np.flatnonzero(group == k)
        if one.picture and plain.uv is None and len(some):
            shelf.without_places(one.picture.name)
        pixels = shelf.pixels(one.picture) if one.picture and plain.uv is not None else None
        if pixels is not None and one.picture and plain.uv is not None:
            bare = np.isnan(plain.uv[some]).any(axis=(1, 2))
            placed = some[~bare]
            groups.append((placed, Look(uv=one.picture.place(plain.uv[placed]), picture=pixels)))
            some = some[bare]
        groups.append((some, _coloured(plain, some, one)))
    return together([group for group in groups if len(group[0])]), notes + pictures.notes


class _Shelf:
    """The pictures that an OBJ file's materials name, each read once."""

    def __init__(self, path: Path, pictures: PictureReader) -> None:
        self._path, self._pictures = path, pictures
        self._read: dict[tuple[Path | None, str], NDArray[np.uint8] | None] = {}

    def pixels(self, picture: Picture) -> NDArray[np.uint8] | None:
        """Give a picture, None where it is missing or damaged; then there is a note."""
        name, key = picture.name, (picture.named_by, picture.name)
        if key not in self._read:
            data = read_beside(self._path, name, first=picture.named_by)
            if data is None:
                self._pictures.notes.append(f"the picture {short(name)} is missing: it is left out")
            self._read[key] = None if data is None else self._pictures.pixels(data, name)
        return self._read[key]

    def without_places(self, name: str) -> None:
        """Note that the model has no texture coordinates for a picture."""
        self._pictures.notes.append(f"the picture {short(name)} is left out: no face has a place in it")


def _coloured(plain: Look, some: Ints, material: Material) -> Look:
    """What faces show that have no picture."""
    uv = None if plain.uv is None else plain.uv[some]
    if plain.rgb is not None:
        return Look(plain.rgb[some], uv)
    if material.colour is None:
        return Look(uv=uv)
    colour = levels(np.clip(material.colour, 0, 1))
    return Look(np.broadcast_to(colour, (len(some), 3, 3)).copy(), uv)


def _library(path: Path, lines: Lines) -> tuple[dict[str, Material], list[str]]:
    """All materials that the file names, and notes on what is missing."""
    known: dict[str, Material] = {}
    notes = []
    libraries = [lines.rest(int(k)).strip("\"' ") for k in lines.starting(b"mtllib")]
    for whole in dict.fromkeys(libraries):
        names = whole.split() if find_beside(path, whole) is None else [whole]
        if not any(find_beside(path, name) for name in names):
            names = [whole]
        for name in names:
            data = read_beside(path, name)
            if data is None:
                notes.append(
                    f"the file of materials {short(name)} is missing, and with it colours and pictures"
                )
            else:
                known = {**parse_mtl(data, find_beside(path, name)), **known}
    return known, list(dict.fromkeys(notes))
