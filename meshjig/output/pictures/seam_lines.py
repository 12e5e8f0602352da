"""The cuts of an atlas as lines on a picture of the model, where a chart meets itself too."""

from typing import Any

import numpy as np

from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.types import Atlas, Floats, Ints
from meshjig.output.pictures.scene import Scene
from meshjig.output.pictures.view import View

__all__ = ["cuts", "draw_lines"]

_NEAR = 4e-3  # radii of the model: what lies no farther behind what is seen is seen itself
_INK = (30, 30, 30)


def cuts(atlas: Atlas) -> Ints:
    """List the edges (k, 2), vertices of the mesh, over which an atlas is cut open; borders are none."""
    F, G = atlas.mesh.F.ravel(), atlas.F_uv.ravel()
    twin = edges(atlas.mesh.F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    after = next_halfedge(h)
    apart = (G[h] != G[next_halfedge(twin[h])]) | (G[after] != G[twin[h]])
    return np.stack([F[h[apart]], F[after[apart]]], 1)


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

    seen = (ends - view.eye) @ view.axes.T
    place = (seen[..., :2] / seen[..., 2:] - view.centre) / view.half
    pixel = (place * [1, -1] + 1) * size / 2
    pen = ImageDraw.Draw(image)
    for line in pixel[_visible(scene, view, ends.mean(1))].reshape(-1, 4).tolist():
        pen.line(line, fill=_INK, width=2)


def _visible(scene: Scene, view: View, points: Floats) -> Any:
    """Tell which points (k, 3) of the surface nothing lies before, (k,) bool."""
    eye = (view.eye - scene.middle) / scene.radius
    toward = (points - scene.middle) / scene.radius - eye
    far = np.linalg.norm(toward, axis=1)
    rays = (toward / far[:, None]).astype(np.float32)
    start = np.broadcast_to(eye.astype(np.float32), rays.shape).copy()
    found = scene.embree.run(start, rays, output=1)
    return (found["primID"] < 0) | (found["tfar"] > far - _NEAR)
