"""The picture of a scan, its texture or its colours, on the outer side of the pieces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.components import components
from meshjig.mesh.measure import area_vectors, barycentric, unit
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.scan.source import Source

__all__ = ["Texture", "colour_of_vertex", "textures"]

_FACING = 0.5  # cosine between a face and the surface under it; less, and it is a wall
_SWATCH = 8  # pixels a side for a piece's own colour, below the scan's picture


@dataclass(frozen=True)
class Texture:
    """What the faces of one piece show: the scan's picture outside, the piece's own colour elsewhere."""

    outer: Bools  # (m,)
    rgb: Floats  # (m, 3, 3), sRGB at the corners, 0 to 1
    uv: Floats | None = None  # (m, 3, 2), into the image
    image: Any = None  # PIL.Image, the same for all pieces; holds a swatch of every piece's colour


def textures(
    solids: Sequence[tuple[Floats, Ints]],
    colours: Floats,
    surface: Mesh,
    source: Source,
    to_source: Floats,
    depth: tuple[float, float],
) -> list[Texture] | None:
    """Carry the picture of a scan over to the pieces, by the closest point of the surface it came with.

    Parameters
    ----------
    solids : sequence of (V (n, 3), F (m, 3)), mm
    colours : (p, 3) float64, sRGB, a colour a piece
    surface : Mesh, what the pieces were cut from
    source : Source, which may show a texture or colours
    to_source : (4, 4) float64, takes mm to the coordinates of the source
    depth : two floats, mm; how far from the surface the outer sheet lies, least and most

    Returns
    -------
    list of Texture, or None where the source has no picture
    """
    picture = _Picture.of(source)
    if picture is None:
        return None
    V, F, _, piece = concatenate([Mesh(*solid) for solid in solids])
    middle, normal = V[F].mean(1), unit(area_vectors(V, F))
    distance, below, _ = _closest(middle, surface.V, surface.F)
    facing = np.einsum("ij,ij->i", normal, unit(area_vectors(surface.V, surface.F))[below]) > _FACING
    outer = facing & (distance >= depth[0]) & (distance <= depth[1])
    rgb = np.broadcast_to(colours[piece][:, None], (len(F), 3, 3)).copy()
    corners, face = picture.under(_moved(V, to_source), F[outer], _moved(middle[outer], to_source))
    rgb[outer] = picture.colours(face, corners)
    uv, image = picture.with_swatches(colours, piece, outer, face, corners)
    parts = np.split(np.arange(len(F)), np.cumsum([len(G) for _, G in solids])[:-1])
    return [Texture(outer[p], rgb[p], None if uv is None else uv[p], image) for p in parts]


def colour_of_vertex(F: Ints, texture: Texture) -> Floats:
    """Give vertices the mean colour of their outer corners, and their piece's own where they have none.

    Parameters
    ----------
    F : (m, 3) int64
    texture : Texture

    Returns
    -------
    (n, 3) float64, sRGB, 0 to 1
    """
    n = int(F.max(initial=-1)) + 1
    weight = np.repeat(np.where(texture.outer, 1.0, 1e-9), 3)
    total = np.bincount(F.ravel(), weight, n)
    rgb = texture.rgb.reshape(-1, 3)
    return np.stack([np.bincount(F.ravel(), weight * rgb[:, k], n) for k in range(3)], 1) / total[:, None]


class _Picture:
    """A source that shows something, and where in it things are."""

    def __init__(self, source: Source) -> None:
        self.V, self.F, self.look = source.vertices, source.faces, source.look
        self.island = components(self.F)[1]

    @classmethod
    def of(cls, source: Source) -> _Picture | None:
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
        _, home, _ = _closest(middle, self.V, self.F)
        used, corner = np.unique(F, return_inverse=True)
        _, near, _ = _closest(V[used], self.V, self.F)
        near = near[corner.reshape(-1, 3)]
        face = np.where(self.island[near] == self.island[home][:, None], near, home[:, None])
        return barycentric(self.V, self.F, face.ravel(), V[F].reshape(-1, 3)).reshape(-1, 3, 3), face

    def colours(self, face: Ints, bary: Floats) -> Floats:
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
    ) -> tuple[Floats | None, Any]:
        """Put a swatch of every piece's colour below the image: uv (m, 3, 2) of all faces, and the image."""
        if self.look.picture is None:
            return None, None
        from PIL import Image

        height, width = self.look.picture.shape[:2]
        a_row = max(width // _SWATCH, 1)
        rows = -(-len(colours) // a_row)
        total = height + rows * _SWATCH
        image = Image.new("RGB", (max(width, _SWATCH), total))
        image.paste(Image.fromarray(self.look.picture), (0, 0))
        row, column = np.divmod(np.arange(len(colours)), a_row)
        for tint, x, y in zip(colours, column * _SWATCH, height + row * _SWATCH, strict=True):
            image.paste(tuple(np.rint(255 * tint).astype(int).tolist()), (x, y, x + _SWATCH, y + _SWATCH))
        middle = (np.stack([column, row], 1) + 0.5) * _SWATCH + [0, height]
        uv = np.repeat((middle / image.size * [1, -1] + [0, 1])[piece][:, None], 3, 1)
        own = self._uv(face, bary)
        own[..., 1] = 1 - (1 - own[..., 1]) * height / total
        own[..., 0] *= width / image.size[0]
        uv[outer] = own
        return uv, image

    def _uv(self, face: Ints, bary: Floats) -> Floats:
        """Give places in the image; those of a picture that repeats are brought back into it."""
        assert self.look.uv is not None
        uv = self._mixed(self.look.uv, face, bary)
        repeats = self.look.uv.min() < 0 or self.look.uv.max() > 1
        return np.where((uv < 0) | (uv > 1), uv % 1.0, uv) if repeats else np.clip(uv, 0.0, 1.0)

    def _mixed(self, at_corners: Floats, face: Ints, bary: Floats) -> Floats:
        """Interpolate what faces have at their corners (m, 3, d), at places in faces, (k, 3, d)."""
        return np.einsum("kcj,kcjd->kcd", bary, at_corners[face])


def _moved(points: Floats, matrix: Floats) -> Floats:
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def _closest(points: Floats, V: Floats, F: Ints) -> tuple[Floats, Ints, Floats]:
    """The distance to a mesh, the face that is nearest, and the nearest point."""
    import igl

    square, face, nearest = igl.point_mesh_squared_distance(points, V, F)[:3]
    return np.sqrt(square), np.asarray(face, np.int64), nearest
