"""Cut a mesh along a level plane: what lies above stays, in one piece with its new border."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.components import fans
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import edge_lengths

__all__ = ["PlaneCut", "cut_level"]

_SNAP = (
    0.1  # of the shortest edge there: vertices nearer to the plane are put on it, lest needles come of them
)


class PlaneCut(NamedTuple):
    """The part of a mesh above a plane."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    on_plane: Bools  # (n,)


def cut_level(V: Floats, F: Ints, axis: int, height: float) -> PlaneCut:
    """Cut a mesh at a height along an axis, and keep what is above.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, manifold
    axis : int, 0, 1 or 2
    height : float, in the units of V

    Returns
    -------
    PlaneCut
        Manifold; without faces where nothing is above.
    """
    e = edges(F)
    V, side = _sides(V, e.E, axis, height)
    a, b = e.E.T
    cut = np.flatnonzero(side[a] * side[b] < 0)
    a, b = a[cut], b[cut]
    t = ((V[a, axis] - height) / (V[a, axis] - V[b, axis]))[:, None]
    points = (1 - t) * V[a] + t * V[b]
    points[:, axis] = height
    new = np.full(len(e.E), -1)
    new[cut] = len(V) + np.arange(len(cut))
    of_face = side[F]
    stays = (of_face >= 0).all(axis=1) & (of_face > 0).any(axis=1)
    faces = [F[stays], *_clipped(F, of_face, new[e.edge_of_halfedge].reshape(-1, 3))]
    G, used = fans(np.concatenate(faces))
    on_plane = np.concatenate([side == 0, np.ones(len(points), bool)])
    return PlaneCut(np.concatenate([V, points])[used], G, on_plane[used])


def _sides(V: Floats, E: Ints, axis: int, height: float) -> tuple[Floats, Ints]:
    """Put vertices that are next to a plane on it; on which side each is, 1 above, 0 on it, -1 below."""
    length = edge_lengths(V, E)
    shortest = np.full(len(V), np.inf)
    for end in E.T:
        np.minimum.at(shortest, end, length)
    level = V[:, axis] - height
    near = np.abs(level) <= _SNAP * shortest
    V = V.copy()
    V[near, axis] = height
    return V, np.where(near, 0, np.sign(level)).astype(np.int64)


def _clipped(F: Ints, side: Ints, new: Ints) -> list[Ints]:
    """Give the parts above of faces that the plane cuts; edges that it cuts have new vertices, (m, 3)."""
    parts = []
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        here, after, before = side[:, k], side[:, i], side[:, j]
        tip = (here > 0) & (after < 0) & (before < 0)
        parts.append(np.stack([F[tip, k], new[tip, k], new[tip, j]], 1))
        foot = (here < 0) & (after > 0) & (before > 0)
        p, q = new[foot, k], new[foot, j]  # on the edges to the corners after and before
        parts.append(np.stack([p, F[foot, i], F[foot, j]], 1))
        parts.append(np.stack([p, F[foot, j], q], 1))
        half = (here == 0) & (after > 0) & (before < 0)  # through a corner and the edge opposite to it
        parts.append(np.stack([F[half, k], F[half, i], new[half, i]], 1))
        half = (here == 0) & (after < 0) & (before > 0)
        parts.append(np.stack([F[half, k], new[half, i], F[half, j]], 1))
    return parts
