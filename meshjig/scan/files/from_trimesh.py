"""What trimesh has loaded, a mesh or a scene, as a mesh as it came."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Ints
from meshjig.scan.files.attachments import as_rgb
from meshjig.scan.files.join import join
from meshjig.scan.source import Look, Source

__all__ = ["from_trimesh"]

_MADE_UP = 2  # pixels a side of what trimesh shows where a material has no picture


def from_trimesh(loaded: Any) -> Source:
    """Take over from trimesh what a puzzle can use.

    Parameters
    ----------
    loaded : trimesh.Trimesh, trimesh.PointCloud or trimesh.Scene

    Returns
    -------
    Source
        A scene's meshes, each in its place, as one; points only where it has no meshes. Its unit is not among
        that, as trimesh guesses units from names of files.

    Raises
    ------
    InputError
        It lies in a plane, as a Path2D does.
    """
    if not hasattr(loaded, "geometry"):
        return _source_of(loaded)
    parts = loaded.dump()
    meshes = [mesh for mesh in parts if len(getattr(mesh, "faces", ()))]
    return join([_source_of(part) for part in meshes or [x for x in parts if hasattr(x, "vertices")][:1]])


def _source_of(mesh: Any) -> Source:
    V = np.array(getattr(mesh, "vertices", np.zeros((0, 3))), np.float64)
    if V.size and V.shape[1:] != (3,):
        raise InputError(
            f"a {type(mesh).__name__} is no surface: its vertices have shape {V.shape}",
            hint="give a trimesh.Trimesh, or extrude it to one",
        )
    V = V.reshape(-1, 3)
    F = np.array(getattr(mesh, "faces", np.zeros((0, 3))), np.int64).reshape(-1, 3)
    visual: Any = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None) if len(F) and (F.min() >= 0) and (F.max() < len(V)) else None
    if kind == "texture":
        return Source(V, F, _of_texture(F, visual))
    if kind == "face":
        colours = np.asarray(visual.face_colors, np.uint8)[:, None, :3]
        return Source(V, F, Look(np.repeat(colours, 3, axis=1)))
    if kind == "vertex":
        return Source(V, F, Look(np.asarray(visual.vertex_colors, np.uint8)[F][..., :3]))
    return Source(V, F)


def _of_texture(F: Ints, visual: Any) -> Look:
    uv = getattr(visual, "uv", None)
    at_corners = None if uv is None or not len(uv) else np.asarray(uv, np.float64)[F]
    material = getattr(visual, "material", None)
    image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
    if at_corners is not None and image is not None and min(image.size) > _MADE_UP:
        return Look(uv=at_corners, picture=as_rgb(image))
    colour = np.array(getattr(material, "main_color", (255, 255, 255, 255)), np.uint8)[:3]
    return Look(np.broadcast_to(colour, (len(F), 3, 3)).copy(), at_corners)
