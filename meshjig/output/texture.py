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
    source: Any,
    to_source: Floats,
    depth: tuple[float, float],
) -> list[Texture] | None:
    """Carry the picture of a scan over to the pieces, by the closest point of the surface it came with.

    Parameters
    ----------
    solids : sequence of (V (n, 3), F (m, 3)), mm
    colours : (p, 3) float64, sRGB, a colour a piece
    surface : Mesh, what the pieces were cut from
    source : trimesh.Trimesh, with a texture, or with colours of vertices or faces
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
    """A source with texture or colours, and where in it things are."""

    def __init__(self, source: Any, image: Any) -> None:
        self.V = np.asarray(source.vertices, np.float64)
        self.F = np.asarray(source.faces, np.int64)
        self.image = image
        self.uv = np.zeros((0, 2)) if image is None else np.asarray(source.visual.uv, np.float64)
        self.rgb = np.zeros((0, 3, 3))
        if image is None:
            by_face = source.visual.kind == "face"
            tint = np.asarray(source.visual.face_colors if by_face else source.visual.vertex_colors)
            self.rgb = (np.repeat(tint[:, None], 3, 1) if by_face else tint[self.F])[..., :3] / 255.0
        self.island = components(self.F)[1]

    @classmethod
    def of(cls, source: Any) -> _Picture | None:
        visual = getattr(source, "visual", None)
        kind = getattr(visual, "kind", None)
        if visual is not None and kind in ("vertex", "face"):
            tint = visual.face_colors if kind == "face" else visual.vertex_colors
            return cls(source, None) if np.ptp(np.asarray(tint)[..., :3], axis=0).any() else None
        material = getattr(visual, "material", None)
        image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
        if kind != "texture" or getattr(visual, "uv", None) is None or image is None:
            return None
        made_up = min(image.size) <= 2  # what trimesh shows where a material has no image
        return None if made_up else cls(source, image.convert("RGB"))

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
        if self.image is None:
            return np.clip(np.einsum("kcj,kcjd->kcd", bary, self.rgb[face]), 0, 1)
        pixels = np.asarray(self.image)
        height, width = pixels.shape[:2]
        uv = self._uv(face, bary)
        column = np.clip((uv[..., 0] * width).astype(np.int64), 0, width - 1)
        row = np.clip(((1 - uv[..., 1]) * height).astype(np.int64), 0, height - 1)
        return pixels[row, column] / 255.0

    def with_swatches(
        self, colours: Floats, piece: Ints, outer: Bools, face: Ints, bary: Floats
    ) -> tuple[Floats | None, Any]:
        """Put a swatch of every piece's colour below the image: uv (m, 3, 2) of all faces, and the image."""
        if self.image is None:
            return None, None
        from PIL import Image

        width, height = self.image.size
        a_row = max(width // _SWATCH, 1)
        rows = -(-len(colours) // a_row)
        total = height + rows * _SWATCH
        image = Image.new("RGB", (max(width, _SWATCH), total))
        image.paste(self.image, (0, 0))
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
        uv = np.einsum("kcj,kcjd->kcd", bary, self.uv[self.F[face]])
        repeats = self.uv.min() < 0 or self.uv.max() > 1
        return np.where((uv < 0) | (uv > 1), uv % 1.0, uv) if repeats else np.clip(uv, 0.0, 1.0)


def _moved(points: Floats, matrix: Floats) -> Floats:
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def _closest(points: Floats, V: Floats, F: Ints) -> tuple[Floats, Ints, Floats]:
    """The distance to a mesh, the face that is nearest, and the nearest point."""
    import igl

    square, face, nearest = igl.point_mesh_squared_distance(points, V, F)[:3]
    return np.sqrt(square), np.asarray(face, np.int64), nearest
