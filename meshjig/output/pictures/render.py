"""Pictures by ray casting: smooth shades, crisp dark lines where one thing ends and another begins."""

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Bools, Ints
from meshjig.mesh.measure import unit
from meshjig.mesh.rays import Floats32
from meshjig.output.pictures.colours import to_srgb
from meshjig.output.pictures.scene import Hits, Scene, cast
from meshjig.output.pictures.view import View

__all__ = ["light_of", "open_sky", "render"]


_LINE = np.float32(0.03)  # linear brightness of a line
_JUMP = 0.02  # in depth, radii of the model: what is behind begins
_CONTRAST = 0.08  # in linear light: a crease or a shadow's edge, worth more rays


_KEY = (-0.45, 0.65, -0.62)  # towards the lamp, in the camera's right, up, forward
_CLEAR_AIR = 0.35  # depth behind the nearest point at which fog begins, radii of the model
_REACH = 0.25  # how far away something still shades, radii of the model
_TILE = 4


def render(
    scene: Scene, view: View, size: int = 800, *, line: float = 1.0, fog: float = 0.0
) -> NDArray[np.uint8]:
    """Draw a scene on white.

    Parameters
    ----------
    scene : Scene
    view : View
    size : int, pixels along each side
    line : float, 0 to 1, how dark lines are
    fog : float, 0 to 1, how much the farthest parts fade

    Returns
    -------
    (size, size, 3) uint8, sRGB

    Notes
    -----
    One ray a pixel; pixels at which something changes get four. All light is summed up linearly.
    """
    rows, columns = np.divmod(np.arange(size * size), size)
    first = cast(scene, view, size, columns + 0.5, rows + 0.5)
    near = float(first.depth[first.ray].min(initial=np.inf))
    sky = open_sky(scene, first, size)
    light = light_of(scene, view, first, sky, fog, near)
    id1 = first.id.reshape(size, size)
    busy = np.flatnonzero(_changes(id1, first.depth.reshape(size, size), light[:, 1].reshape(size, size)))
    sub_column = (columns[busy, None] + np.array([0.25, 0.75, 0.25, 0.75])).ravel()
    sub_row = (rows[busy, None] + np.array([0.25, 0.25, 0.75, 0.75])).ravel()
    fine = cast(scene, view, size, sub_column, sub_row)
    fine_light = light_of(scene, view, fine, np.repeat(sky[busy], 4), fog, near)
    id2 = np.repeat(np.repeat(id1, 2, 0), 2, 1)
    at = (2 * sub_row).astype(np.int64), (2 * sub_column).astype(np.int64)
    id2[at] = fine.id
    cover = line * _line_cover(id2, *at)[:, None]
    light[busy] = (fine_light * (1 - cover) + _LINE * cover).reshape(-1, 4, 3).mean(axis=1)
    return _display(light).reshape(size, size, 3)


def _changes(identity: Ints, depth: Floats32, light: Floats32) -> Bools:
    """Mark pixels near which the id, the depth or the light jumps, (size, size)."""
    near = np.zeros(identity.shape, bool)
    for a, d, mark in ((identity, depth, near), (identity.T, depth.T, near.T)):
        _mark_sides(a[1:] != a[:-1], mark)
        mark[1:-1] |= np.abs(d[2:] - 2 * d[1:-1] + d[:-2]) > _JUMP
    for mark in (near, near.T):
        wide = mark.copy()
        wide[1:] |= mark[:-1]
        wide[:-1] |= mark[1:]
        mark |= wide
    for value, mark in ((light, near), (light.T, near.T)):
        _mark_sides(np.abs(value[1:] - value[:-1]) > _CONTRAST, mark)
    return near


def _mark_sides(change: Bools, mark: Bools) -> None:
    """Mark both sides of every change from row to row."""
    mark[1:] |= change
    mark[:-1] |= change


def _line_cover(identity: Ints, row: Ints, column: Ints) -> Floats32:
    """How much of each subpixel a line of three subpixels' width covers, with soft borders."""
    border = np.zeros((identity.shape[0] + 2, identity.shape[1] + 2), bool)
    inside = border[1:-1, 1:-1]
    _mark_sides(identity[1:] != identity[:-1], inside)
    _mark_sides((identity[:, 1:] != identity[:, :-1]).T, inside.T)
    flat, width = border.ravel(), border.shape[1]
    here = (row + 1) * width + column + 1
    cover = np.zeros(len(here), np.float32)
    for down, weight_down in ((-1, 0.25), (0, 0.5), (1, 0.25)):
        for right, weight_right in ((-1, 0.25), (0, 0.5), (1, 0.25)):
            cover += np.float32(2 * weight_down * weight_right) * flat[here + down * width + right]
    return np.minimum(cover, 1)


def _display(light: Floats32) -> NDArray[np.uint8]:
    bytes_of = np.round(255 * to_srgb(np.linspace(0, 1, 4096))).astype(np.uint8)
    return bytes_of[(np.clip(light, 0, 1) * 4095 + 0.5).astype(np.int64)]


def open_sky(scene: Scene, hits: Hits, size: int) -> Floats32:
    """The share of the sky that nothing near hides (ambient occlusion).

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
    hidden = scene.rays.is_hidden(origin, direction, reach)
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
