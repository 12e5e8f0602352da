"""What the faces of a PLY file show: colours and places in pictures, by whatever names are in use."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats, starts
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.beside import read_beside, short
from meshjig.scan.files.looks import corner_colours, together
from meshjig.scan.files.ply_rows import Columns
from meshjig.scan.files.surface import Surface, levels
from meshjig.scan.source import Look

__all__ = ["Shown", "look_of_ply"]

_COLOURS = [
    tuple(pattern.format(name) for name in names)
    for names in (("red", "green", "blue"), ("r", "g", "b"))
    for pattern in ("{}", "diffuse_{}", "{}_diffuse", "color_{}", "colour_{}", "vertex_{}", "ambient_{}")
]
_PLACES = [("s", "t"), ("u", "v"), ("texture_u", "texture_v"), ("texture_s", "texture_t"), ("s0", "t0")]
_PLACES += [("u0", "v0"), ("tex_u", "tex_v"), ("texcoord_u", "texcoord_v"), ("uv_u", "uv_v"), ("tu", "tv")]
_WEDGES = ("texcoord", "texcoords", "uv")


class Shown(NamedTuple):
    """Triangles, and the tables that tell what they show."""

    made: Surface
    vertices: Columns
    faces: Columns
    n_faces: int  # polygons before those that are no rows of the table of faces


def look_of_ply(path: Path, pictures: PictureReader, names: list[str], shown: Shown) -> Look:
    """Give what triangles show.

    Parameters
    ----------
    path : Path, of the PLY file
    pictures : PictureReader, which takes notes of what is missing
    names : list of str, of pictures
    shown : Shown

    Returns
    -------
    Look

    Raises
    ------
    InputError
        A pipe or a device is named.
    """
    rgb, uv = _rgb(shown), _uv(shown)
    if uv is None or not names:
        pictures.notes += [
            f"the picture {short(name)} is left out: no face has a place in it" for name in names
        ]
        return Look(rgb, uv)
    number = _by_face(shown, "texnumber", -1 if len(names) > 1 else 0).astype(np.int64)
    number[np.isnan(uv).any(axis=(1, 2)) | (number >= len(names))] = -1
    pictures.expected = len(names)
    groups = []
    for k, name in enumerate(names):
        some = np.flatnonzero(number == k)
        if not len(some):
            continue
        data = read_beside(path, name)
        if data is None:
            pictures.notes.append(f"the picture {short(name)} is missing: it is left out")
        pixels = None if data is None else pictures.pixels(data, name)
        if pixels is None:
            number[some] = -1
        else:
            groups.append((some, Look(uv=uv[some], picture=pixels)))
    if not groups:
        return Look(rgb, uv)
    bare = np.flatnonzero(number < 0)
    if len(bare):
        groups.append((bare, Look(None if rgb is None else rgb[bare])))
    return together(groups)


def _rgb(shown: Shown) -> NDArray[np.uint8] | None:
    """The colours of corners, (m, 3, 3)."""
    has_rows = (shown.made.polygon < shown.n_faces).all()  # strips have none of their own
    return corner_colours(shown.made, _colours(shown.faces) if has_rows else None, _colours(shown.vertices))


def _colours(table: Columns) -> NDArray[np.uint8] | None:
    for names in _COLOURS:
        if set(names) <= table.scalars.keys():
            values = np.stack([table.scalars[name].astype(np.float64) for name in names], 1)
            kind = table.kinds[names[0]]
            return levels(values / 257 if kind == "u2" else values, whole=kind[0] in "iu")
    return None


def _uv(shown: Shown) -> Floats | None:
    """The texture coordinates of corners, those of faces before those of vertices, (m, 3, 2)."""
    made = shown.made
    if not len(made.F):
        return None
    for name in _WEDGES:
        if name in shown.faces.lists and (made.polygon < shown.n_faces).all():
            return _wedges(shown, name)
    for names in _PLACES:
        if set(names) <= shown.vertices.scalars.keys():
            uv = np.stack([shown.vertices.scalars[name].astype(np.float64) for name in names], 1)
            return uv[made.F]
    return None


def _wedges(shown: Shown, name: str) -> Floats:
    """Texture coordinates from a list of faces, two a corner; NaN for faces whose list is none such."""
    values, sizes = shown.faces.lists[name]
    polygon, corner = shown.made.polygon, shown.made.corner
    corners = next(lists.sizes for key, lists in shown.faces.lists.items() if key not in _WEDGES)
    rank = corner - starts(corners)[polygon][:, None]
    fits = sizes[polygon] == 2 * corners[polygon]
    at = np.where(fits[:, None], starts(sizes)[polygon][:, None] + 2 * rank, 0)
    pairs = np.append(values.astype(np.float64), [0.0, 0.0])
    uv = np.stack([pairs[at], pairs[at + 1]], 2)
    uv[~fits | ~np.isfinite(uv).all(axis=(1, 2))] = np.nan
    return uv


def _by_face(shown: Shown, name: str, otherwise: int) -> NDArray:
    """A property of faces, for triangles (m,)."""
    known = shown.made.polygon < shown.n_faces
    if name not in shown.faces.scalars:
        return np.full(len(known), otherwise)
    row = np.where(known, shown.made.polygon, 0)
    return np.where(known, np.nan_to_num(shown.faces.scalars[name][row], nan=-1), -1)
