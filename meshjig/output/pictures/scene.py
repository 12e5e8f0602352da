"""Triangles ready for rays, what rays from a camera meet, and lines on what they see."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.creases import crease_normals
from meshjig.mesh.mesh import concatenate
from meshjig.mesh.rays import Floats32, RayScene
from meshjig.output.pictures.colours import to_linear
from meshjig.output.pictures.view import View
from meshjig.output.piece import Piece

__all__ = ["Hits", "Scene", "cast", "draw_lines", "scene_of", "scene_of_pieces", "shifted"]


_NEAR = 4e-3  # radii of the model: what lies no farther behind what is seen is seen itself
_INK = (30, 30, 30)


@dataclass(frozen=True)
class Scene:
    """Triangles ready for rays: centred and scaled to radius 1, since Embree has 32-bit floats."""

    rays: RayScene
    middle: Floats  # (3,)
    radius: float
    F: Ints  # (m, 3)
    corner: Ints  # (m, 3), into the normals
    normal: Floats32  # (k, 3), of vertices split along creases
    colour: Floats32  # (m, 3), linear light
    id: Ints  # (m,)

    def scaled(self, points: Floats) -> Floats:
        """Take points (..., 3) from mm to the scene's own scale."""
        return (points - self.middle) / self.radius


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
    corner, normal = crease_normals(V, F)
    colour = to_linear(colour_of_face).astype(np.float32)
    middle, radius = _ball(V)
    return Scene(_rays(V, F), middle, radius, F, corner, normal.astype(np.float32), colour, id_of_face)


def scene_of_pieces(pieces: Sequence[Piece]) -> Scene:
    """Prepare pieces, each in its colours, its number from 0 as the id."""
    V, F, _, piece_of_face = concatenate(pieces)
    return scene_of(V, F, np.concatenate([piece.colour_of_face for piece in pieces]), piece_of_face)


def shifted(scene: Scene, V: Floats) -> Scene:
    """Give the same scene with connected parts of it shifted, not turned, to vertices V (n, 3)."""
    middle, radius = _ball(V)
    return replace(scene, rays=_rays(V, scene.F), middle=middle, radius=radius)


def _ball(V: Floats) -> tuple[Floats, float]:
    """The middle and the radius of a ball around points."""
    low, high = V.min(axis=0), V.max(axis=0)
    return (low + high) / 2, max(float(np.linalg.norm(high - low)) / 2, 1e-12)


def _rays(V: Floats, F: Ints) -> RayScene:
    middle, radius = _ball(V)
    return RayScene((V - middle) / radius, F, robust=True)


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
    toward = view.rays(x, y)
    eye = scene.scaled(view.eye).astype(np.float32)
    found = scene.rays.hits(np.broadcast_to(eye, toward.shape), toward)
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
    """Blend the normals of a face's corners."""
    total = np.zeros((len(face), 3), np.float32)
    for k, weight in enumerate((1 - u - v, u, v)):
        total += weight[:, None] * scene.normal[scene.corner[face, k]]
    return total / np.maximum(np.sqrt(np.einsum("ij,ij->i", total, total)), np.float32(1e-12))[:, None]


def draw_lines(image: Any, scene: Scene, view: View, ends: Floats, size: int) -> None:
    """Draw segments on a picture of a scene, as far as they are not hidden.

    Parameters
    ----------
    image : PIL.Image, the picture
    scene : Scene
    view : View
    ends : (k, 2, 3) float64, mm, on the surface
    size : int, pixels along each side of it
    """
    from PIL import ImageDraw

    place = (view.on_plane(ends) - view.centre) / view.half
    pixel = (place * [1, -1] + 1) * size / 2
    pen = ImageDraw.Draw(image)
    for line in pixel[_visible(scene, view, ends.mean(1))].reshape(-1, 4).tolist():
        pen.line(line, fill=_INK, width=2)


def _visible(scene: Scene, view: View, points: Floats) -> Any:
    """Tell which points (k, 3) of the surface nothing lies before, (k,) bool."""
    eye = scene.scaled(view.eye)
    toward = scene.scaled(points) - eye
    far = np.linalg.norm(toward, axis=1)
    found = scene.rays.hits(np.broadcast_to(eye, toward.shape), toward / far[:, None])
    return (found["primID"] < 0) | (found["tfar"] > far - _NEAR)
