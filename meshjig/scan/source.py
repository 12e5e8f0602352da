"""A mesh as it came, with its colours or its texture: what trimesh calls the same, without trimesh."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats, Ints

__all__ = ["Source", "Visual", "source_of"]


@dataclass(frozen=True)
class Visual:
    """What faces show."""

    kind: str | None  # "vertex", "face", "texture"
    vertex_colors: NDArray[np.uint8] | None = None  # (n, 4)
    face_colors: NDArray[np.uint8] | None = None  # (m, 4)
    uv: Floats | None = None  # (n, 2), in widths of the texture
    pixels: NDArray[np.uint8] | None = None  # (height, width, 3), the texture

    @cached_property
    def material(self) -> Any:
        """The texture as a PIL.Image: ``material.image``, which is None where there is none."""
        from PIL import Image

        return SimpleNamespace(image=None if self.pixels is None else Image.fromarray(self.pixels))


@dataclass(frozen=True)
class Source:
    """A mesh as it came."""

    vertices: Floats  # (n, 3), in the units of the file
    faces: Ints  # (m, 3)
    visual: Visual


def source_of(mesh: Any) -> Source:
    """Take over from a trimesh.Trimesh, or a trimesh.PointCloud, what a puzzle can use."""
    V = np.array(getattr(mesh, "vertices", np.zeros((0, 3))), np.float64).reshape(-1, 3)
    F = np.array(getattr(mesh, "faces", np.zeros((0, 3))), np.int64).reshape(-1, 3)
    visual: Any = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None)
    if not len(F) or kind not in ("vertex", "face", "texture"):
        return Source(V, F, Visual(None))
    if kind == "texture":
        uv = getattr(visual, "uv", None)
        flat = None if uv is None else np.array(uv, np.float64)
        return Source(V, F, Visual(kind, uv=flat, pixels=_pixels(visual)))
    if kind == "face":
        return Source(V, F, Visual(kind, face_colors=np.array(visual.face_colors, np.uint8)))
    return Source(V, F, Visual(kind, vertex_colors=np.array(visual.vertex_colors, np.uint8)))


def _pixels(visual: Any) -> NDArray[np.uint8] | None:
    material = getattr(visual, "material", None)
    image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
    return None if image is None else np.asarray(image.convert("RGB"))
