"""Hold a surface clear of another one around it: nowhere nearer than asked, and seldom farther."""

from __future__ import annotations

import numpy as np

from meshjig.finish.depth import Depth
from meshjig.measure import area_vectors, unit
from meshjig.topology import edges, next_halfedge
from meshjig.types import Bools, Floats, Ints

__all__ = ["cleared"]

_REACH = 0.5  # edges of a face, that a vertex may be moved to its depth
_ENOUGH = 0.998  # of the clearance
_ON_EDGE = ([0, 0, 0, 1], [0, 1, 1, 1])  # means of these are places on an edge, and on a face
_ON_FACE = ([0, 0, 0, 0, 1, 2], [0, 1, 1, 1, 1, 2], [0, 1, 2, 2, 2, 2])
_AIM = 1.04  # of the clearance, to which vertices give way: between the places looked at, it is less
_ROUNDS = 12
_CREASE = 0.95  # cosine between the faces of a crease; over a flatter one a face hardly sags
_TURNED = 0.3  # cosine between a face before and after


def cleared(V: Floats, F: Ints, around: Depth, clearance: float) -> tuple[Floats, float]:
    """Move the vertices of a surface inside another so that its faces keep the clearance.

    First every vertex goes to the depth that was asked for. Flat faces then still come too near where the
    other surface has creases that stand out towards them; there, vertices give way until they don't.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, about at that depth, oriented outward
    around : Depth, of the other surface
    clearance : float, mm

    Returns
    -------
    V : (n, 3) float64, mm
    least : float, mm
        The least distance found from places on edges and faces, and from the other surface's vertices.
    """
    E = edges(F).E
    reach = _REACH * float(np.median(np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1)))
    depth, foot = around.at(V)
    away = unit(V - foot) * np.sign(depth)[:, None]
    lack = np.where(np.abs(clearance - depth) < reach, clearance - depth, 0.0)
    V = _unfolded(V, F, lack[:, None] * away)
    gone = np.zeros(len(V))
    V, least = _given_way(V, F, gone, away, reach, clearance, _Room([np.arange(len(V))[:, None], E, F], F, around, reach))
    hot = gone > 0
    E, G = E[hot[E].any(axis=1)], F[hot[F].any(axis=1)]
    finer = [E[:, ends] for ends in _ON_EDGE] + [G[:, corners] for corners in _ON_FACE]
    V, fine = _given_way(V, F, gone, away, reach, clearance, _Room([*finer, E, G], F, around, reach))
    return V, float(np.minimum(np.where(hot, np.inf, least), fine).min())


def _given_way(
    V: Floats, F: Ints, gone: Floats, away: Floats, reach: float, clearance: float, room: _Room
) -> tuple[Floats, Floats]:
    """Move vertices off while there is not enough room; add to how far each has gone, and give its room."""
    moved = np.ones(len(V), bool)
    for _ in range(_ROUNDS):
        room.update(V, moved)
        least = room.least_at_vertices(V)
        step = np.clip(_AIM * clearance - least, 0.0, reach - gone)
        moved = (least < _ENOUGH * clearance) & (step > 0)
        if not moved.any():
            break
        step[~moved] = 0.0
        went = _unfolded(V, F, step[:, None] * away)
        moved = (went != V).any(axis=1)
        V = went
        gone += np.where(moved, step, 0.0)
    return V, least


def _unfolded(V: Floats, F: Ints, step: Floats) -> Floats:
    """Let vertices take a step, but for those of faces that it would turn over."""
    before = unit(area_vectors(V, F))
    step = step.copy()
    while True:
        over = np.einsum("ij,ij->i", unit(area_vectors(V + step, F)), before) < _TURNED
        stuck = F[over]
        if not step[stuck].any():
            return V + step
        step[stuck] = 0.0


class _Room:
    """How far a surface is from the one around it: from means of some vertices, and from the other's vertices."""

    def __init__(self, parts: list[Ints], F: Ints, around: Depth, spacing: float) -> None:
        self.F, self.around, self.parts = F, around, parts
        self.depth = tuple(np.empty(len(part)) for part in self.parts)
        self.outside = _outstanding(around, 0.5 * spacing)
        self.below, self.distance = np.zeros(0, np.int64), np.zeros(0)

    def update(self, V: Floats, moved: Bools) -> None:
        """Measure again where vertices have moved."""
        for part, depth in zip(self.parts, self.depth, strict=True):
            old = np.flatnonzero(moved[part].any(axis=1))
            depth[old] = self.around.at(V[part[old]].mean(axis=1))[0]
        inside, self.below, _ = Depth(V, self.F).nearest(self.outside)
        self.distance = -inside
        near = self.distance < 2 * np.median(self.distance)
        self.outside, self.below, self.distance = self.outside[near], self.below[near], self.distance[near]

    def least_at_vertices(self, V: Floats) -> Floats:
        """Give the least distance that each vertex has to do with, (n,)."""
        least = np.full(len(V), np.inf)
        for part, depth in (*zip(self.parts, self.depth, strict=True), (self.F[self.below], self.distance)):
            np.minimum.at(least, part.ravel(), np.repeat(depth, part.shape[1]))
        return least


def _outstanding(around: Depth, spacing: float) -> Floats:
    """Give corners of a surface, and points along the creases that stand out to its inside, (k, 3)."""
    V, F = around.V, around.F
    twin = edges(F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    N = unit(area_vectors(V, F))
    a, b = V[F.ravel()[h]], V[F.ravel()[next_halfedge(h)]]
    tip = V[F.ravel()[next_halfedge(next_halfedge(twin[h]))]]
    crease = np.einsum("ij,ij->i", N[h // 3], N[twin[h] // 3]) < _CREASE
    crease &= np.einsum("ij,ij->i", tip - a, N[h // 3]) > 0
    a, b = a[crease], b[crease]
    count = np.ceil(np.linalg.norm(b - a, axis=1) / spacing).astype(np.int64)
    which = np.repeat(np.arange(len(a)), count)
    rank = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    return np.concatenate([V, a[which] + ((rank + 0.5) / count[which])[:, None] * (b - a)[which]])
