"""Where on a curved sheet a rectangle fits: the widest room that is nearly flat."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from meshjig.measure import area_vectors, unit, vertex_normals
from meshjig.topology import border_halfedges, compact, components, next_halfedge
from meshjig.types import Bools, Floats, Ints

__all__ = ["Place", "places"]

_STEEP = 0.75  # cosine; what leans more against the text's plane is no ground for it
_SEEDS = 5
_CANDIDATES = 60
_TURNS = np.pi * np.arange(12) / 12
_STEP = 0.35  # mm between the points that stand for a border
_GRAIN = 1.0  # mm2 of ground for each place that is tried
_UPRIGHT = 0.5  # of the height, that room is given up for a text that stands upright


class Place(NamedTuple):
    """A plane on a sheet, and the ground around its origin."""

    origin: Floats  # (3,)
    axes: Floats  # (3, 3), rows: along the text, up, towards the reader
    ground: Ints  # faces, all of which lean less than 37 degrees against the plane


def places(V: Floats, F: Ints, size: Floats, margin: float) -> Iterator[Place]:
    """Find places for a rectangle on a sheet, the best of each neighbourhood.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, the sheet, facing the reader
    size : (2,) float64, mm, of the rectangle
    margin : float, mm, from the rectangle to the border of the sheet, at least

    Yields
    ------
    Place
        Upright rather than upside down, whether y or z is up.
    """
    if not len(F):
        return
    F, kept = compact(F)
    V = V[kept]
    middle = V[F].mean(axis=1)
    room = _distances(middle, _border_points(V, F))
    lean = unit(vertex_normals(V, F)[F].mean(axis=1))
    area = area_vectors(V, F)
    least = size.min() / 2 + margin
    for _ in range(_SEEDS):
        seed = int(room.argmax())
        if room[seed] < 0.7 * least:  # the widest place need not be around the middle of a face
            return
        near = np.linalg.norm(middle - middle[seed], axis=1) < np.linalg.norm(size) / 2
        room[near] = 0.0
        toward = unit(area[near].sum(axis=0))
        ground = _connected(F, lean @ toward > _STEEP, seed)
        if len(ground):
            found = _widest(V, F[ground], toward, size, margin)
            if found is not None:
                yield Place(*found, ground)


def _connected(F: Ints, chosen: Bools, seed: int) -> Ints:
    """List the chosen faces that hang together with one of them."""
    if not chosen[seed]:
        return np.zeros(0, np.int64)
    faces = np.flatnonzero(chosen)
    label = components(F[faces])[1]
    return faces[label == label[np.searchsorted(faces, seed)]]


def _widest(V: Floats, F: Ints, toward: Floats, size: Floats, margin: float) -> tuple[Floats, Floats] | None:
    """Lay the rectangle where it is clearest of the border; give its middle and axes."""
    up = unit(np.array([0.0, 1.0, 1.0]) - (toward[1] + toward[2]) * toward)
    if not up.any():
        up = unit(np.cross(toward, [1.0, 0.0, 0.0]))
    axes = np.stack([np.cross(up, toward), up, toward])
    flat = V @ axes.T
    border = _border_points(flat[:, :2], F)
    spots = _spots(flat, F)
    round_about = _distances(spots[:, :2], border)
    fitting = np.flatnonzero(round_about > size.min() / 2 + margin)
    if not len(fitting):
        return None
    spots = spots[fitting[:: 1 + len(fitting) // _CANDIDATES]]
    clear = _clearance(spots[:, :2], border, size / 2)
    worth = np.where(clear > margin, clear + _UPRIGHT * size[1] * np.abs(np.cos(_TURNS)), -np.inf)
    best, turn = np.unravel_index(int(worth.argmax()), worth.shape)
    if clear[best, turn] <= margin:
        return None
    angle = _TURNS[turn] if _TURNS[turn] <= np.pi / 2 else _TURNS[turn] - np.pi
    cos, sin = np.cos(angle), np.sin(angle)
    turned = np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]]) @ axes
    return spots[best] @ axes, turned


def _clearance(spots: Floats, border: Floats, half: Floats) -> Floats:
    """Give how far rectangles stay from the border, negative where they reach over it, (k, turns)."""
    away = border[None] - spots[:, None]
    clear = np.empty((len(spots), len(_TURNS)))
    for k, turn in enumerate(_TURNS):
        cos, sin = np.cos(turn), np.sin(turn)
        x = np.abs(cos * away[..., 0] + sin * away[..., 1]) - half[0]
        y = np.abs(cos * away[..., 1] - sin * away[..., 0]) - half[1]
        outside = np.hypot(np.maximum(x, 0), np.maximum(y, 0))
        clear[:, k] = (outside + np.minimum(np.maximum(x, y), 0)).min(axis=1)
    return clear


def _border_points(V: Floats, F: Ints) -> Floats:
    """Put points along the border of a sheet, evenly enough; (k, d)."""
    h = border_halfedges(F)
    a, b = V[F.ravel()[h]], V[F.ravel()[next_halfedge(h)]]
    count = np.maximum(np.ceil(np.linalg.norm(b - a, axis=1) / _STEP), 1).astype(np.int64)
    which = np.repeat(np.arange(len(h)), count)
    rank = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    return a[which] + ((rank + 0.5) / count[which])[:, None] * (b - a)[which]


def _spots(V: Floats, F: Ints) -> Floats:
    """Spread points over faces, at least one in each, in an order that skips about; (k, 3)."""
    area = np.linalg.norm(area_vectors(V, F), axis=1) / 2
    count = np.maximum(np.ceil(area / _GRAIN), 1).astype(np.int64)
    which = np.repeat(np.arange(len(F)), count)
    rank = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    u, v = (rank * 0.7548776662 + 1 / 3) % 1, (rank * 0.5698402910 + 1 / 3) % 1
    over = u + v > 1
    u, v = np.where(over, 1 - u, u), np.where(over, 1 - v, v)
    corner = V[F[which]]
    return corner[:, 0] + u[:, None] * (corner[:, 1] - corner[:, 0]) + v[:, None] * (corner[:, 2] - corner[:, 0])


def _distances(points: Floats, others: Floats) -> Floats:
    """Give how far each point is from the nearest of the others."""
    from scipy.spatial import cKDTree

    if not len(others):
        return np.full(len(points), np.inf)
    return np.asarray(cKDTree(others).query(points)[0], np.float64)
