"""Soft light: a lamp over the left shoulder, a sky that hollows see less of, fog in the distance."""

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.measure import unit
from meshjig.output.pictures.scene import Hits, Scene
from meshjig.output.pictures.view import View

__all__ = ["light_of", "open_sky"]

Floats32 = NDArray[np.float32]

_KEY = (-0.45, 0.65, -0.62)  # towards the lamp, in the camera's right, up, forward
_CLEAR_AIR = 0.35  # depth behind the nearest point at which fog begins, radii of the model
_REACH = 0.25  # how far away something still shades, radii of the model
_TILE = 4


def open_sky(scene: Scene, hits: Hits, size: int) -> Floats32:
    """Give the share of the sky that nothing near hides (ambient occlusion).

    Parameters
    ----------
    scene : Scene
    hits : Hits of one ray a pixel, row by row
    size : int, pixels along each side

    Returns
    -------
    (size * size,) float32, 0 to 1

    Notes
    -----
    One ray a pixel in one of 16 directions, averaged over tiles that hold them all.
    """
    from scipy.ndimage import uniform_filter

    row, column = np.divmod(hits.ray, size)
    which = (row % _TILE) * _TILE + column % _TILE
    direction = hits.normal + _sphere(_TILE**2)[which] * np.float32(0.98)
    direction /= np.sqrt(np.einsum("ij,ij->i", direction, direction))[:, None]
    origin = hits.point + np.float32(2e-3) * hits.normal
    reach = np.full(len(origin), _REACH, np.float32)
    hidden = scene.embree.run(origin, direction, dists=reach, query="OCCLUDED") >= 0
    free = np.zeros(size * size, np.float32)
    free[hits.ray] = ~hidden
    here = (hits.id >= 0).astype(np.float32)
    free, here = (uniform_filter(x.reshape(size, size), 2 * _TILE, mode="constant") for x in (free, here))
    return (free / np.maximum(here, np.float32(1e-6))).ravel()


def light_of(
    scene: Scene, view: View, hits: Hits, sky: Floats32, fog: float = 0.0, near: float = 0.0
) -> Floats32:
    """Give the light that each ray brings back, white where it met nothing.

    Parameters
    ----------
    scene : Scene
    view : View
    hits : Hits of k rays
    sky : (k,) float32, from ``open_sky``
    fog : float, 0 to 1, how much the farthest parts fade
    near : float, depth of the nearest hit; fog begins a little behind it

    Returns
    -------
    (k, 3) float32, linear red, green, blue
    """
    light = np.ones((len(hits.id), 3), np.float32)
    direct, ambient = _direct_and_ambient(view, hits)
    seen = sky[hits.ray]
    strength = ambient * seen + direct * (0.4 + 0.6 * seen)
    colour = scene.colour[hits.face] * strength[:, None]
    if fog:
        far = np.clip((hits.depth[hits.ray] - near - _CLEAR_AIR) / (2 - _CLEAR_AIR), 0, 1)
        colour = 1 - (1 - colour) * (1 - np.float32(fog) * far)[:, None]
    light[hits.ray] = colour
    return light


def _direct_and_ambient(view: View, hits: Hits) -> tuple[Floats32, Floats32]:
    """Give direct and ambient light: a key light over the left shoulder, a sky, a faint dark rim."""
    normal, toward = hits.normal, hits.toward
    key = (unit(np.array(_KEY)) @ view.axes).astype(np.float32)
    up = view.axes[1].astype(np.float32)
    facing = -np.einsum("ij,ij->i", normal, toward) / np.sqrt(np.einsum("ij,ij->i", toward, toward))
    rim = 1 - 0.35 * (1 - np.clip(facing, 0, 1)) ** 3
    direct = 0.72 * np.clip((normal @ key + 0.15) / 1.15, 0, None) * rim
    ambient = (0.40 + 0.14 * (normal @ up)) * rim
    return direct, ambient


def _sphere(n: int) -> Floats32:
    """Spread n points over the unit sphere, in an order that jumps about."""
    k = np.arange(n) * 7 % n
    z = 1 - (2 * k + 1) / n
    turn = k * np.pi * (3 - np.sqrt(5))
    return np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], 1).astype(
        np.float32
    )
