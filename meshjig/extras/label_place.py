"""Where on a curved sheet a rectangle fits: the widest room that is nearly flat."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, ranks, row_of
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges, compact, next_halfedge
from meshjig.mesh.measure import area_vectors, unit, vertex_normals

__all__ = ["LabelPlace", "label_places"]

_LEAN = (0.9, 0.75)  # cosines; what leans more against the rectangle is no ground for it
_SEEDS = 5
_NARROW = 0.4  # of a rectangle's height: the widest room need not be around the middle of a face
_CANDIDATES = 40
_TURNS = np.pi * np.arange(12) / 12
_STEP = 0.4  # mm between the points that stand for a border
_GRAIN = 1.0  # mm2 of ground for each place that is tried
_UPRIGHT = 0.5  # of the height, that room is given up for a text that stands upright


class LabelPlace(NamedTuple):
    """A plane on a sheet, and the ground around its origin."""

    origin: Floats  # (3,)
    axes: Floats  # (3, 3), rows: along the text, up, towards the reader
    ground: Ints  # faces


def label_places(
    V: Floats, F: Ints, sizes: Sequence[Floats], margin: float
) -> Iterator[tuple[int, LabelPlace]]:
    """Find places for a rectangle on a sheet: flat ones first, then large ones.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, the sheet, facing the reader
    sizes : (2,) float64 each, mm, of the rectangle, the largest first
    margin : float, mm, from the rectangle to the border of the sheet, at least

    Yields
    ------
    index of a size, LabelPlace
        Upright rather than upside down, whether y or z is up. The ground leans against the plane by less
        than 26 degrees, then by less than 42.
    """
    if not len(F):
        return
    F, kept = compact(F)
    sheet = _Sheet(V[kept], F)
    for lean in _LEAN:
        for i, size in enumerate(sizes):
            for seed, near in sheet.wide_parts(size):
                toward = unit(sheet.area[near].sum(axis=0))
                ground = _connected(F, sheet.normal @ toward > lean, seed)
                found = _widest(sheet, ground, toward, size, margin) if len(ground) else None
                if found is not None:
                    yield i, LabelPlace(*found, ground)


class _Sheet:
    """A sheet, and what all places need to know of it."""

    def __init__(self, V: Floats, F: Ints) -> None:
        self.V, self.F = V, F
        self.middle = V[F].mean(axis=1)
        self.normal = unit(vertex_normals(V, F)[F].mean(axis=1))
        self.area = area_vectors(V, F)
        self.border = border_halfedges(F)
        self.room = _distances(self.middle, _points_along(V, F, self.border))

    def wide_parts(self, size: Floats) -> Iterator[tuple[int, Bools]]:
        """Give faces far from the border, and what a rectangle around them could cover."""
        room = self.room.copy()
        for _ in range(_SEEDS):
            seed = int(room.argmax())
            if room[seed] < _NARROW * size.min():
                return
            near = np.linalg.norm(self.middle - self.middle[seed], axis=1) < np.linalg.norm(size) / 2
            room[near] = 0.0
            yield seed, near


def _connected(F: Ints, chosen: Bools, seed: int) -> Ints:
    """List the chosen faces that are connected with one of them."""
    if not chosen[seed]:
        return np.zeros(0, np.int64)
    faces = np.flatnonzero(chosen)
    label = components(F[faces])[1]
    return faces[label == label[np.searchsorted(faces, seed)]]


def _widest(
    sheet: _Sheet, ground: Ints, toward: Floats, size: Floats, margin: float
) -> tuple[Floats, Floats] | None:
    """Lay the rectangle where it is clearest of the border; give its middle and axes."""
    up = unit(np.array([0.0, 1.0, 1.0]) - (toward[1] + toward[2]) * toward)
    if not up.any():
        up = unit(np.cross(toward, [1.0, 0.0, 0.0]))
    axes = np.stack([np.cross(up, toward), up, toward])
    flat, F = sheet.V @ axes.T, sheet.F[ground]
    edge = _points_along(flat[:, :2], F, border_halfedges(F))
    rim = _points_along(flat[:, :2], sheet.F, sheet.border[np.isin(sheet.border // 3, ground)])
    spots = _spots(flat, F)
    fitting = _distances(spots[:, :2], edge) > size.min() / 2
    fitting &= _distances(spots[:, :2], rim) > size.min() / 2 + margin
    if not fitting.any():
        return None
    spots = spots[fitting]
    spots = spots[:: 1 + len(spots) // _CANDIDATES]
    clear = np.minimum(
        _clearance(spots[:, :2], edge, size / 2), _clearance(spots[:, :2], rim, size / 2) - margin
    )
    worth = np.where(clear > 0, clear + _UPRIGHT * size[1] * np.abs(np.cos(_TURNS)), -np.inf)
    best, turn = np.unravel_index(int(worth.argmax()), worth.shape)
    if clear[best, turn] <= 0:
        return None
    angle = _TURNS[turn] if _TURNS[turn] <= np.pi / 2 else _TURNS[turn] - np.pi
    cos, sin = np.cos(angle), np.sin(angle)
    turned = np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]]) @ axes
    return spots[best] @ axes, turned


def _clearance(spots: Floats, border: Floats, half: Floats) -> Floats:
    """Give how far along its sides a rectangle could grow, negative where it reaches over; (k, turns)."""
    if not len(border):
        return np.full((len(spots), len(_TURNS)), np.inf)
    x, y = (border[None, :, k] - spots[:, None, k] for k in range(2))
    clear = np.empty((len(spots), len(_TURNS)))
    for k, turn in enumerate(_TURNS):
        cos, sin = np.cos(turn), np.sin(turn)
        along, across = np.abs(cos * x + sin * y) - half[0], np.abs(cos * y - sin * x) - half[1]
        clear[:, k] = np.maximum(along, across).min(axis=1)
    return clear


def _points_along(V: Floats, F: Ints, h: Ints) -> Floats:
    """Put points along half-edges, evenly enough; (k, d)."""
    a, b = V[F.ravel()[h]], V[F.ravel()[next_halfedge(h)]]
    count = np.maximum(np.ceil(np.linalg.norm(b - a, axis=1) / _STEP), 1).astype(np.int64)
    which = row_of(count)
    return a[which] + ((ranks(count) + 0.5) / count[which])[:, None] * (b - a)[which]


def _spots(V: Floats, F: Ints) -> Floats:
    """Spread points over faces, at least one in each, in an order that skips about; (k, 3)."""
    area = np.linalg.norm(area_vectors(V, F), axis=1) / 2
    count = np.maximum(np.ceil(area / _GRAIN), 1).astype(np.int64)
    which, rank = row_of(count), ranks(count)
    u, v = (rank * 0.7548776662 + 1 / 3) % 1, (rank * 0.5698402910 + 1 / 3) % 1
    over = u + v > 1
    u, v = np.where(over, 1 - u, u), np.where(over, 1 - v, v)
    corner = V[F[which]]
    return (
        corner[:, 0] + u[:, None] * (corner[:, 1] - corner[:, 0]) + v[:, None] * (corner[:, 2] - corner[:, 0])
    )


def _distances(points: Floats, others: Floats) -> Floats:
    """Give how far each point is from the nearest of the others."""
    from scipy.spatial import cKDTree

    if not len(others):
        return np.full(len(points), np.inf)
    return np.asarray(cKDTree(others).query(points)[0], np.float64)
