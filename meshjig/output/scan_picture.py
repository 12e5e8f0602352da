"""What a scan shows at places on it, and the picture in which pieces show it."""

from __future__ import annotations

import io
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.components import components
from meshjig.mesh.measure import barycentric
from meshjig.scan.source import Source

__all__ = ["Picture", "ScanPicture", "closest", "moved"]

_PACKED = 4  # of 9: a photograph becomes hardly smaller beyond, and takes three times as long
_SWATCH = 8  # pixels a side for a piece's own colour, below the scan's picture


@dataclass(frozen=True, eq=False)
class Picture:
    """The picture that pieces show."""

    pixels: NDArray[np.uint8]  # (height, width, 3), sRGB

    @cached_property
    def png(self) -> bytes:
        """The picture as a PNG file."""
        from PIL import Image

        buffer = io.BytesIO()
        Image.fromarray(self.pixels).save(buffer, "PNG", compress_level=_PACKED)
        return buffer.getvalue()


class ScanPicture:
    """A source that shows something, and what is shown where."""

    def __init__(self, source: Source) -> None:
        self.V, self.F, self.look = source.vertices, source.faces, source.look
        shown = self.look.rgb if self.look.picture is None else self.look.uv
        assert shown is not None
        self.island = components(_apart_by(self.F, shown))[1]

    @classmethod
    def of(cls, source: Source) -> ScanPicture | None:
        """Give None where nothing is shown, or one colour only."""
        rgb = source.look.rgb
        if source.look.picture is not None or (rgb is not None and np.ptp(rgb, axis=(0, 1)).any()):
            return cls(source)
        return None

    def under(self, V: Floats, F: Ints, middle: Floats) -> tuple[Floats, Ints]:
        """Give barycentric places (k, 3, 3) of corners, and the faces (k, 3) they are in.

        A corner takes the face nearest to it when that belongs to the same island of the picture as what
        is under the middle of its face; else its place is extrapolated from there.
        """
        _, home, _ = closest(middle, self.V, self.F)
        used, corner = np.unique(F, return_inverse=True)
        _, near, _ = closest(V[used], self.V, self.F)
        near = near[corner.reshape(-1, 3)]
        face = np.where(self.island[near] == self.island[home][:, None], near, home[:, None])
        return barycentric(self.V, self.F, face.ravel(), V[F].reshape(-1, 3)).reshape(-1, 3, 3), face

    def colours(self, face: Ints, bary: Floats) -> Floats:
        """Give what is shown at places in faces, (k, 3, 3), sRGB, 0 to 1."""
        pixels = self.look.picture
        if pixels is None:
            assert self.look.rgb is not None
            return np.clip(self._mixed(self.look.rgb / 255.0, face, bary), 0, 1)
        height, width = pixels.shape[:2]
        uv = self._uv(face, bary)
        column = np.clip((uv[..., 0] * width).astype(np.int64), 0, width - 1)
        row = np.clip(((1 - uv[..., 1]) * height).astype(np.int64), 0, height - 1)
        return pixels[row, column] / 255.0

    def with_swatches(
        self, colours: Floats, piece: Ints, outer: Bools, face: Ints, bary: Floats
    ) -> tuple[Floats | None, Picture | None]:
        """Put a swatch of every piece's colour below the picture: uv (m, 3, 2) of all faces, and all that."""
        if self.look.picture is None:
            return None, None
        height, width = self.look.picture.shape[:2]
        a_row = max(width // _SWATCH, 1)
        rows = -(-len(colours) // a_row)
        pixels = np.zeros((height + rows * _SWATCH, max(width, _SWATCH), 3), np.uint8)
        pixels[:height, :width] = self.look.picture
        row, column = np.divmod(np.arange(len(colours)), a_row)
        for tint, x, y in zip(colours, column * _SWATCH, height + row * _SWATCH, strict=True):
            pixels[y : y + _SWATCH, x : x + _SWATCH] = np.rint(255 * tint)
        size = np.array(pixels.shape[1::-1])
        middle = (np.stack([column, row], 1) + 0.5) * _SWATCH + [0, height]
        uv = np.repeat((middle / size * [1, -1] + [0, 1])[piece][:, None], 3, 1)
        own = self._uv(face, bary)
        own[..., 1] = 1 - (1 - own[..., 1]) * height / size[1]
        own[..., 0] *= width / size[0]
        uv[outer] = own
        return uv, Picture(pixels)

    def _uv(self, face: Ints, bary: Floats) -> Floats:
        """Give places in the picture, (k, 3, 2); where it repeats, a face lies where its middle is shown."""
        assert self.look.uv is not None
        uv = self._mixed(self.look.uv, face, bary)
        places = self.look.uv.reshape(-1, 6)
        outside = (places.min(axis=1) < 0) | (places.max(axis=1) > 1)
        beyond = outside[face].any(axis=1)
        middle = np.floor(uv.mean(axis=1, keepdims=True))
        return np.clip(uv - np.where(beyond[:, None, None], middle, 0.0), 0.0, 1.0)

    def _mixed(self, at_corners: Floats, face: Ints, bary: Floats) -> Floats:
        """Interpolate what faces have at their corners (m, 3, d), at places in faces, (k, 3, d)."""
        return np.einsum("kcj,kcjd->kcd", bary, at_corners[face])


def _apart_by(F: Ints, shown: NDArray[Any]) -> Ints:
    """Faces (m, 3) whose corners are one vertex only where they show the same, shown (m, 3, d)."""
    corner, rows = F.ravel(), shown.reshape(3 * len(F), -1)
    first = np.zeros(int(F.max(initial=-1)) + 1, np.int64)
    first[corner[::-1]] = np.arange(len(corner))[::-1]
    same: Bools = (rows == rows[first[corner]]).all(axis=1)
    other = np.flatnonzero(~same)
    if not len(other):
        return F
    _, number = np.unique(np.column_stack([corner[other], rows[other]]), axis=0, return_inverse=True)
    apart = corner.copy()
    apart[other] = len(first) + number.ravel()
    return apart.reshape(-1, 3)


def moved(points: Floats, matrix: Floats) -> Floats:
    """Give points (n, 3) moved by a matrix (4, 4)."""
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def closest(points: Floats, V: Floats, F: Ints) -> tuple[Floats, Ints, Floats]:
    """Give the distance of points to a mesh, the faces that are nearest, and the nearest points."""
    import igl

    square, face, nearest = igl.point_mesh_squared_distance(points, V, F)[:3]
    return np.sqrt(square), np.asarray(face, np.int64), nearest
