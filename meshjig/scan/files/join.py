"""Several meshes as one, with all that they show: pictures side by side in one, colours as swatches in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.scan.source import Look, Source

__all__ = ["join"]

_PLAIN = 255  # what a part without colours shows among coloured ones
_SWATCH = 8  # pixels a side of a colour in the picture
_LEVELS = 32  # of a channel, for swatches: a mesh has as many colours as corners, a picture has no room
_ROW = 8192  # pixels of width; pictures that are less wide share a row


def join(parts: Sequence[Source]) -> Source:
    """Make one mesh of several that lie where they belong.

    Parameters
    ----------
    parts : sequence of Source, of one unit and one axis upward

    Returns
    -------
    Source
        Where some parts have pictures, all places are brought into one picture, and a face without one gets
        its mean colour from a swatch there. Pictures that repeat are shown once.
    """
    if len(parts) == 1:
        return parts[0]
    if not parts:
        return Source(np.zeros((0, 3)), np.zeros((0, 3), np.int64))
    V, F, _, _ = concatenate([Mesh(part.vertices, part.faces) for part in parts])
    return Source(V, F, _joined(parts), parts[0].unit, parts[0].up)


def _joined(parts: Sequence[Source]) -> Look:
    looks = [part.look for part in parts]
    pictures = {id(look.picture): look.picture for look in looks if look.picture is not None}
    if len(pictures) == 1 and all(look.picture is not None for look in looks):
        return replace(looks[0], rgb=None, uv=_all_uv(parts))
    if pictures:
        return _in_one_picture(parts, list(pictures.values()))
    if all(look.rgb is None for look in looks):
        return Look(uv=_all_uv(parts))
    return Look(np.concatenate([_rgb(part) for part in parts]), _all_uv(parts))


def _all_uv(parts: Sequence[Source]) -> Floats | None:
    """The UVs of all faces, (m, 3, 2), NaN where there are none; None where nobody has any."""
    if all(part.look.uv is None for part in parts):
        return None
    blank = [np.full((len(part.faces), 3, 2), np.nan) for part in parts]
    return np.concatenate(
        [no if part.look.uv is None else part.look.uv for part, no in zip(parts, blank, strict=True)]
    )


def _rgb(part: Source) -> NDArray[np.uint8]:
    if part.look.rgb is not None:
        return part.look.rgb
    return np.full((len(part.faces), 3, 3), _PLAIN, np.uint8)


def _in_one_picture(parts: Sequence[Source], pictures: list[NDArray[np.uint8]]) -> Look:
    tints = [None if part.look.picture is not None else _mean_colours(part) for part in parts]
    plain = [tint for tint in tints if tint is not None]
    if plain:
        swatches, number = np.unique(np.concatenate(plain), axis=0, return_inverse=True)
        pictures = [*pictures, _palette(swatches)]
    corner, (width, height) = _shelves([(p.shape[1], p.shape[0]) for p in pictures])
    picture = np.zeros((height, width, 3), np.uint8)
    for (x, y), pixels in zip(corner, pictures, strict=True):
        picture[y : y + pixels.shape[0], x : x + pixels.shape[1]] = pixels
    place = {id(pixels): k for k, pixels in enumerate(pictures)}
    uv, done = [], 0
    for part, tint in zip(parts, tints, strict=True):
        if tint is not None:
            row, column = np.divmod(number.ravel()[done : done + len(tint)], _LEVELS)
            at = corner[-1] + (np.stack([column, row], 1) + 0.5) * _SWATCH
            pixel = np.repeat(at[:, None], 3, 1)
            done += len(tint)
        else:
            size = np.array(part.look.picture.shape[1::-1])  # type: ignore[union-attr]
            pixel = _once(part.look.uv, size) + corner[place[id(part.look.picture)]]
        uv.append(pixel / (width, height) * (1, -1) + (0, 1))
    each = {id(part.look.picture): part.look.picture_sizes for part in parts if part.look.picture is not None}
    sizes = tuple(size for sizes in each.values() for size in sizes)
    return Look(uv=np.concatenate(uv), picture=picture, sizes=sizes)


def _mean_colours(part: Source) -> NDArray[np.uint8]:
    """A colour a face, (m, 3), of few in all."""
    step = 255 / (_LEVELS - 1)
    return np.rint(np.rint(_rgb(part).mean(axis=1) / step) * step).astype(np.uint8)


def _palette(colours: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A picture of swatches, ``_LEVELS`` of them in a row."""
    rows = -(-len(colours) // _LEVELS)
    grid = np.zeros((rows * _LEVELS, 3), np.uint8)
    grid[: len(colours)] = colours
    return grid.reshape(rows, _LEVELS, 3).repeat(_SWATCH, axis=0).repeat(_SWATCH, axis=1)


def _once(uv: Floats | None, size: NDArray[np.int64]) -> Floats:
    """Places in pixels (m, 3, 2), downward, half a pixel within a picture of a size (width, height)."""
    assert uv is not None
    middle = np.floor(uv.mean(axis=1, keepdims=True))
    within = uv - np.where(((uv < 0) | (uv > 1)).any(axis=(1, 2), keepdims=True), middle, 0.0)
    pixel: Floats = (within * (1, -1) + (0, 1)) * size
    return np.clip(np.nan_to_num(pixel), 0.5, size - 0.5)


def _shelves(sizes: Sequence[tuple[int, int]]) -> tuple[NDArray[np.int64], tuple[int, int]]:
    """Place rectangles on shelves, the highest first: upper left corners (k, 2), and the size of all."""
    limit = max(_ROW, max(width for width, _ in sizes))
    corner = np.zeros((len(sizes), 2), np.int64)
    x = y = shelf = widest = 0
    for k in sorted(range(len(sizes)), key=lambda k: -sizes[k][1]):
        width, height = sizes[k]
        if x + width > limit:
            x, y, shelf = 0, y + shelf, 0
        corner[k] = x, y
        x, shelf = x + width, max(shelf, height)
        widest = max(widest, x)
    return corner, (widest, y + shelf)
