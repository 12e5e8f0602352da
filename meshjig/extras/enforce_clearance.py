"""Hold a surface clear of another one around it: nowhere nearer than asked, and seldom farther."""

from __future__ import annotations

import numpy as np

from meshjig.extras.depth import Depth
from meshjig.mesh.arrays import Bools, Floats, Ints, ranks, row_of
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.intersections import crossing_faces
from meshjig.mesh.measure import area_vectors, unit

__all__ = ["enforce_clearance"]

_REACH = 0.5  # edges of a face, that a vertex may be moved to its depth
_YIELD = 0.25  # edges of a face, that it gives way after that: more would fold
_ENOUGH = 0.998  # of the clearance
_AIM = 1.04  # of the clearance, to which vertices give way: between the places looked at, it is less
_LEFT = 0.97  # of the clearance: what is nearer in the end is to be cut off
_ROUNDS = 3
_SPACING = 0.4  # of the clearance, between the places looked at on creases that stand out
_TURNED = 0.3  # cosine between a face before and after a step that turns it over
_ON_EDGE = ([0, 0, 0, 1], [0, 1], [0, 1, 1, 1])  # means of these corners are places on an edge, and on a face
_ON_FACE = ([0, 0, 0, 0, 1, 2], [0, 1, 1, 1, 1, 2], [0, 1, 2, 2, 2, 2])
_CREASE = 0.95  # cosine between the faces of a crease; over a flatter one a face hardly sags
_FAR = 1.25  # times the distance that most have; what is farther at first is not looked at again


def enforce_clearance(V: Floats, F: Ints, around: Depth, clearance: float) -> tuple[Floats, Ints]:
    """Move the vertices of a surface inside another so that its faces keep the clearance.

    First every vertex goes to the depth that was asked for. Flat faces then still come too near where the
    other surface has creases that stand out towards them; there, vertices give way, but not so far that
    faces turn over.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, about at that depth, oriented outward
    around : Depth, of the other surface
    clearance : float, mm

    Returns
    -------
    V : (n, 3) float64, mm
    near : (k,) int64
        Faces of the other surface that it still comes too near to, because they stand out too far.
    """
    E = edges(F).E
    edge = float(np.median(np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1)))
    depth, foot = around.at(V)
    away = unit(V - foot) * np.sign(depth)[:, None]
    lack = clearance - depth
    step = np.where((lack < _REACH * edge) & (lack > -_YIELD * edge), lack, 0.0)
    first, V = V, _stepped(V, F, step[:, None] * away)
    places = [np.arange(len(V))[:, None], F, *(E[:, ends] for ends in _ON_EDGE)]
    room = Clearance(places, F, around, min(_SPACING * clearance, _YIELD * edge))
    V, gone = _given_way(V, np.zeros(len(V)), away, edge, clearance, room)
    G = F[(gone > 0)[F].any(axis=1)]
    room.look_at([G[:, corners] for corners in _ON_FACE])
    V, _ = _given_way(V, gone, away, edge, clearance, room)
    final = _uncrossed(V, first, F)
    room.update(final, (final != V).any(axis=1))
    return final, room.too_near(final, _LEFT * clearance)


def _given_way(
    V: Floats, gone: Floats, away: Floats, edge: float, clearance: float, room: Clearance
) -> tuple[Floats, Floats]:
    """Move vertices off while there is not enough room; give them, and how far each has gone in all."""
    moved = np.zeros(len(V), bool)
    for turn in range(_ROUNDS):
        room.update(V, moved)
        least = room.at_vertices(len(V))
        step = np.clip(_AIM * clearance - least, 0.0, _YIELD * edge - gone)
        step[least >= _ENOUGH * clearance] = 0.0
        if turn == _ROUNDS - 1 or not step.any():
            break
        went = _stepped(V, room.F, step[:, None] * away)
        moved = (went != V).any(axis=1)
        V, gone = went, gone + np.where(moved, step, 0.0)
    return V, gone


def _stepped(V: Floats, F: Ints, step: Floats) -> Floats:
    """Let vertices take a step, but for those of faces that it would turn over."""
    before = unit(area_vectors(V, F))
    step = step.copy()
    while True:
        over = np.einsum("ij,ij->i", unit(area_vectors(V + step, F)), before) < _TURNED
        if not step[F[over]].any():
            return V + step
        step[F[over]] = 0.0


def _uncrossed(V: Floats, first: Floats, F: Ints) -> Floats:
    """Send vertices back to where they came from until no two faces cross, as none did there."""
    V = V.copy()
    while True:
        back = np.unique(F[crossing_faces(V, F)])
        back = back[(V[back] != first[back]).any(axis=1)]
        if not len(back):
            return V
        V[back] = first[back]


class Clearance:
    """Distances from places on a surface, and from the other surface's corners and creases.

    Parameters
    ----------
    parts : list of (k, c) int64
        Places on the surface, as the means of some of its vertices.
    F : (m, 3) int64, the surface
    around : Depth, of the other surface
    spacing : float, mm, between places on the other surface's creases
    """

    def __init__(self, parts: list[Ints], F: Ints, around: Depth, spacing: float) -> None:
        self.F, self._around, self._parts = F, around, parts
        self._depth = [np.full(len(part), np.nan) for part in parts]
        self._outside = _outstanding(around, spacing)
        self._below, self._distance = np.zeros(0, np.int64), np.zeros(0)

    def look_at(self, parts: list[Ints]) -> None:
        """Add other places on the surface; they are measured at the next update."""
        self._parts = [*self._parts, *parts]
        self._depth += [np.full(len(part), np.nan) for part in parts]

    def update(self, V: Floats, moved: Bools) -> None:
        """Measure again where some vertices (n,) have moved; V is (n, 3)."""
        old = [
            np.flatnonzero(moved[part].any(axis=1) | np.isnan(depth))
            for part, depth in zip(self._parts, self._depth, strict=True)
        ]
        points = [V[part[rows]].mean(axis=1) for part, rows in zip(self._parts, old, strict=True)]
        depth = np.split(
            self._around.at(np.concatenate(points))[0], np.cumsum([len(rows) for rows in old])[:-1]
        )
        for known, rows, new in zip(self._depth, old, depth, strict=True):
            known[rows] = new
        first = not len(self._below)
        if first or moved.any():
            inside, self._below, _ = Depth(V, self.F).nearest(self._outside)
            self._distance = -inside
        if first:
            near = self._distance < _FAR * np.median(self._distance)
            self._outside, self._below = self._outside[near], self._below[near]
            self._distance = self._distance[near]

    def at_vertices(self, n: int) -> Floats:
        """Give the least distance that each of n vertices has to do with, inf for none."""
        least = np.full(n, np.inf)
        for part, depth in (
            *zip(self._parts, self._depth, strict=True),
            (self.F[self._below], self._distance),
        ):
            np.minimum.at(least, part.ravel(), np.repeat(depth, part.shape[1]))
        return least

    def too_near(self, V: Floats, least: float) -> Ints:
        """List the faces of the other surface that are nearer than a distance, and those beside them."""
        points = [V[part[d < least]].mean(axis=1) for part, d in zip(self._parts, self._depth, strict=True)]
        face = self._around.nearest(np.concatenate([*points, self._outside[self._distance < least]]))[1]
        twin = edges(self._around.F).twin
        return np.unique([face, *(twin[3 * face + k] // 3 for k in range(3))])


def _outstanding(around: Depth, spacing: float) -> Floats:
    """Give the corners of a surface, and places along the creases that stand out to its inside, (k, 3)."""
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
    which = row_of(count)
    return np.concatenate([V, a[which] + ((ranks(count) + 0.5) / count[which])[:, None] * (b - a)[which]])
