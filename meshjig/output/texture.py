"""The picture of a scan, its texture or its colours, on the outer side of the pieces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import area_vectors, barycentric, unit
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.output.scan_picture import Picture, ScanPicture, closest, moved
from meshjig.scan.source import Source

__all__ = ["Texture", "carried", "colour_of_vertex", "textures"]

_ONE_COLOUR = 1e-6  # difference of channels, 0 to 1
_FACING = 0.5  # cosine between a face and the surface under it; less, and it is a wall


@dataclass(frozen=True)
class Texture:
    """What the faces of one piece show: the scan's picture outside, the piece's own colour elsewhere."""

    outer: Bools  # (m,)
    rgb: Floats  # (m, 3, 3), sRGB at the corners, 0 to 1
    uv: Floats | None = None  # (m, 3, 2), into the image
    picture: Picture | None = None  # the same for all pieces; holds a swatch of every piece's colour

    @property
    def shown(self) -> Floats:
        """What corners show: places in the picture, (m, 3, 2), or colours where there is none, (m, 3, 3)."""
        return self.rgb if self.picture is None or self.uv is None else self.uv

    @property
    def colour_of_faces(self) -> Floats | None:
        """The colour of each face, (m, 3); None where faces show more than one, or a picture."""
        if self.picture is not None or np.ptp(self.rgb, axis=1).max(initial=0.0) > _ONE_COLOUR:
            return None
        return self.rgb[:, 0]


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
    shown = ScanPicture.of(source)
    if shown is None:
        return None
    V, F, _, piece = concatenate([Mesh(*solid) for solid in solids])
    middle, normal = V[F].mean(1), unit(area_vectors(V, F))
    distance, below, _ = closest(middle, surface.V, surface.F)
    facing = np.einsum("ij,ij->i", normal, unit(area_vectors(surface.V, surface.F))[below]) > _FACING
    outer = facing & (distance >= depth[0]) & (distance <= depth[1])
    rgb = np.broadcast_to(colours[piece][:, None], (len(F), 3, 3)).copy()
    corners, face = shown.under(moved(V, to_source), F[outer], moved(middle[outer], to_source))
    rgb[outer] = shown.colours(face, corners)
    uv, picture = shown.with_swatches(colours, piece, outer, face, corners)
    parts = np.split(np.arange(len(F)), np.cumsum([len(G) for _, G in solids])[:-1])
    return [Texture(outer[p], rgb[p], None if uv is None else uv[p], picture) for p in parts]


def carried(texture: Texture, old: Mesh, new: Mesh) -> Texture:
    """Give what a mesh shows that lies on another: each face what the face under its middle shows.

    Parameters
    ----------
    texture : Texture, of the old mesh
    old, new : Mesh, mm

    Returns
    -------
    Texture, of the new mesh
    """
    _, below, _ = closest(new.V[new.F].mean(axis=1), old.V, old.F)
    bary = barycentric(old.V, old.F, np.repeat(below, 3), new.V[new.F].reshape(-1, 3)).reshape(-1, 3, 3)

    def moved_over(shown: Floats) -> Floats:
        return np.clip(np.einsum("kcj,kjd->kcd", bary, shown[below]), 0, 1)

    uv = None if texture.uv is None else moved_over(texture.uv)
    return Texture(texture.outer[below], moved_over(texture.rgb), uv, texture.picture)


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
