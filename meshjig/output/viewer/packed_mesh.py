"""The pieces as a small block of bytes that the viewer's script unpacks."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.creases import split_at_creases
from meshjig.mesh.mesh import concatenate
from meshjig.output.piece import Piece

__all__ = ["PackedMesh", "pack"]

_MOST = 65535  # of 16 bits
_NO_PLACE = 0xFFFF_FFFF  # code of a corner that shows nothing of an image
Bytes = NDArray[np.uint8]


@dataclass(frozen=True)
class PackedFacts:
    """What the viewer's script needs to read the bytes."""

    vertices: Ints  # (p,), how many each piece has
    faces: Ints  # (p,)
    step: float  # of the grid, mm
    low: Floats  # (3,), where the grid begins, from the middle of the model's box
    index: int  # width of an index in bytes
    look: str | None  # what else a vertex has: "uv" into an image, "rgb", or nothing


@dataclass(frozen=True)
class PackedMesh:
    """Bytes, and what is needed to read them."""

    data: bytes  # deflated
    facts: PackedFacts


def pack(pieces: Sequence[Piece]) -> PackedMesh:
    """Pack pieces into bytes.

    Parameters
    ----------
    pieces : sequence of Piece

    Returns
    -------
    PackedMesh

    Notes
    -----
    Bytes are those of, in this order, all low before all high ones: x, y and z of the vertices on a grid
    of 65,535 steps along the longest side, as differences to the vertex before; the corners of faces,
    as 0 for the next new vertex, else how long ago a vertex was new; looks. All faces are kept. Vertices
    are doubled along creases, so that normals can be had by summing up over faces.
    """
    V, F, _, piece_of_face = concatenate(pieces)
    creased, origin = split_at_creases(V, F)
    looks = _looks(pieces, creased)
    corner, order = _in_order_of_use(looks.F)
    low, high = V.min(axis=0), V.max(axis=0)
    step = max(float((high - low).max()), 1e-9) / _MOST
    grid = np.rint((V[origin[looks.origin[order]]] - low) / step).astype(np.int64)
    fresh = np.maximum.accumulate(corner)
    ago = np.concatenate([[0], fresh[:-1] + 1]) - corner
    width = 2 if ago.max() <= _MOST else 4
    blocks = [
        _planes(np.diff(grid, axis=0, prepend=0).T.ravel() & _MOST, 2),
        _planes(ago, width),
        looks.data[order].T.ravel(),
    ]
    owner = np.empty(len(order), np.int64)
    owner[corner] = np.repeat(piece_of_face, 3)
    n = len(pieces)
    n_vertices, n_faces = (np.bincount(who, minlength=n) for who in (owner, piece_of_face))
    facts = PackedFacts(n_vertices, n_faces, step, (low - high) / 2, width, looks.kind)
    return PackedMesh(zlib.compress(np.concatenate(blocks).tobytes(), 6), facts)


@dataclass(frozen=True)
class _Looks:
    """What vertices show besides the colour of their piece."""

    kind: str | None
    F: Ints  # (m, 3), into vertices split where looks differ
    origin: Ints  # (n,), the vertex that each was split from
    data: Bytes  # (n, b)


def _looks(pieces: Sequence[Piece], F: Ints) -> _Looks:
    if all(piece.texture is None for piece in pieces):
        n = int(F.max()) + 1
        return _Looks(None, F, np.arange(n), np.zeros((n, 0), np.uint8))
    textures = [piece.texture for piece in pieces]
    outer = np.concatenate(
        [np.zeros(len(p.F), bool) if c is None else c.outer for p, c in zip(pieces, textures, strict=True)]
    )
    if any(texture is not None and texture.uv is not None for texture in textures):
        return _places(F, outer, _of_corners(pieces, "uv", 2))
    return _tints(F, outer, _of_corners(pieces, "rgb", 3))


def _of_corners(pieces: Sequence[Piece], field: str, size: int) -> Floats:
    """Give what corners show, (3 m, size), 0 for pieces without."""
    found = [None if piece.texture is None else getattr(piece.texture, field) for piece in pieces]
    return np.concatenate(
        [
            np.zeros((3 * len(p.F), size)) if x is None else x.reshape(-1, size)
            for p, x in zip(pieces, found, strict=True)
        ]
    )


def _places(F: Ints, outer: Bools, uv: Floats) -> _Looks:
    """Give outer vertices their places in the image, in steps of 1/65,534, split along its seams."""
    u, v = np.rint(np.clip(uv, 0, 1) * (_MOST - 1)).astype(np.int64).T
    code = np.where(np.repeat(outer, 3), u << 16 | v, _NO_PLACE)
    key, corner = np.unique(F.ravel() << 32 | code, return_inverse=True)
    place = key & _NO_PLACE
    data = np.stack([place >> 16 & 255, place & 255, place >> 24, place >> 8 & 255], 1)
    return _Looks("uv", corner.reshape(-1, 3), key >> 32, data.astype(np.uint8))


def _tints(F: Ints, outer: Bools, rgb: Floats) -> _Looks:
    """Give outer vertices the mean colour of their corners; the fourth byte says that they are outer."""
    key, corner = np.unique(2 * F.ravel() + np.repeat(outer, 3), return_inverse=True)
    count = np.bincount(corner)
    mean = np.stack([np.bincount(corner, x) / count for x in rgb.T] + [key % 2], 1)
    return _Looks("rgb", corner.reshape(-1, 3), key // 2, np.rint(255 * mean).astype(np.uint8))


def _in_order_of_use(F: Ints) -> tuple[Ints, Ints]:
    """Number vertices in the order in which faces use them: corners (3 m,), and the old numbers."""
    corner = F.ravel()
    first = np.empty(int(corner.max()) + 1, np.int64)
    first[corner[::-1]] = np.arange(len(corner))[::-1]
    order = np.argsort(first)
    number = np.empty(len(order), np.int64)
    number[order] = np.arange(len(order))
    return number[corner], order


def _planes(values: Ints, width: int) -> Bytes:
    """The lowest bytes of all values, then the next, and so on."""
    return np.concatenate([(values >> 8 * k & 255).astype(np.uint8) for k in range(width)])
