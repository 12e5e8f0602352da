"""Triangles for embree, and what rays from a camera meet."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.measure import area_vectors, unit, vertex_normals
from meshjig.mesh.types import Floats, Ints
from meshjig.output.pictures.srgb import to_linear
from meshjig.output.pictures.view import View

__all__ = ["Hits", "Scene", "cast", "scene_of", "shifted"]

Floats32 = NDArray[np.float32]
_CREASE = 0.85  # cosine between a face and its corner's normal below which the corner is not smoothed


@dataclass(frozen=True)
class Scene:
    """Triangles ready to be hit by rays: centred and scaled to radius 1, since embree has 32-bit floats."""

    embree: Any
    middle: Floats  # (3,)
    radius: float
    F: Ints  # (m, 3)
    face_normal: Floats32  # (m, 3)
    vertex_normal: Floats32  # (n, 3)
    colour: Floats32  # (m, 3), linear light
    id: Ints  # (m,)


@dataclass(frozen=True)
class Hits:
    """What rays met, in the scene's own scale.

    Rays that met nothing have id -1 and depth 0; the other arrays hold hits only.
    """

    id: Ints  # (k,)
    depth: Floats32  # (k,)
    ray: Ints  # (h,), the rays that hit
    face: Ints  # (h,)
    toward: Floats32  # (h, 3), direction of the ray, 1 along the view
    point: Floats32  # (h, 3)
    normal: Floats32  # (h, 3), towards the eye


def scene_of(V: Floats, F: Ints, colour_of_face: Floats, id_of_face: Ints) -> Scene:
    """Prepare a mesh for any number of views.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    colour_of_face : (m, 3) float64, sRGB, 0 to 1
    id_of_face : (m,) int64; a line is drawn where it changes

    Returns
    -------
    Scene
    """
    normal = unit(area_vectors(V, F)).astype(np.float32)
    colour = to_linear(colour_of_face).astype(np.float32)
    corner = vertex_normals(V, F).astype(np.float32)
    return Scene(
        *_hittable(V, F), F=F, face_normal=normal, vertex_normal=corner, colour=colour, id=id_of_face
    )


def shifted(scene: Scene, V: Floats) -> Scene:
    """Give the same scene with connected parts of it shifted, not turned, to vertices V (n, 3)."""
    embree, middle, radius = _hittable(V, scene.F)
    return replace(scene, embree=embree, middle=middle, radius=radius)


def _hittable(V: Floats, F: Ints) -> tuple[Any, Floats, float]:
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    low, high = V.min(axis=0), V.max(axis=0)
    middle, radius = (low + high) / 2, max(float(np.linalg.norm(high - low)) / 2, 1e-12)
    embree = EmbreeScene(robust=True)  # without it, rays slip through between triangles
    TriangleMesh(embree, ((V - middle) / radius).astype(np.float32), F.astype(np.int32))
    return embree, middle, radius


def cast(scene: Scene, view: View, size: int, column: Floats, row: Floats) -> Hits:
    """Send rays through places of a picture.

    Parameters
    ----------
    scene : Scene
    view : View
    size : int, pixels along each side
    column, row : (k,) float64, in pixels; the middle of the first pixel is at 0.5, 0.5

    Returns
    -------
    Hits
    """
    x = (view.centre[0] + view.half * (2 * column / size - 1)).astype(np.float32)
    y = (view.centre[1] + view.half * (1 - 2 * row / size)).astype(np.float32)
    right, up, forward = view.axes.astype(np.float32)
    toward = np.empty((len(column), 3), np.float32)
    for k in range(3):
        toward[:, k] = forward[k] + x * right[k] + y * up[k]
    eye = ((view.eye - scene.middle) / scene.radius).astype(np.float32)
    found = scene.embree.run(np.broadcast_to(eye, toward.shape).copy(), toward, output=1)
    ray = np.flatnonzero(found["primID"] >= 0)
    face = found["primID"][ray]
    toward = toward[ray]
    depth = np.zeros(len(column), np.float32)
    depth[ray] = found["tfar"][ray]
    normal = _smooth_normal(scene, face, found["u"][ray], found["v"][ray])
    normal *= np.where(np.einsum("ij,ij->i", normal, toward) > 0, np.float32(-1), np.float32(1))[:, None]
    identity = np.full(len(column), -1)
    identity[ray] = scene.id[face]
    point = eye + depth[ray, None] * toward
    return Hits(identity, depth, ray, face, toward, point, normal)


def _smooth_normal(scene: Scene, face: Ints, u: Floats32, v: Floats32) -> Floats32:
    """Blend the corners' normals, but for those across a crease."""
    flat = scene.face_normal[face]
    total = np.zeros_like(flat)
    for k, weight in enumerate((1 - u - v, u, v)):
        corner = scene.vertex_normal[scene.F[face, k]]
        creased = np.einsum("ij,ij->i", corner, flat) < _CREASE
        corner[creased] = flat[creased]
        total += weight[:, None] * corner
    return total / np.maximum(np.sqrt(np.einsum("ij,ij->i", total, total)), np.float32(1e-12))[:, None]
