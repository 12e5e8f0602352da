"""Hold a surface clear of another one around it: nowhere nearer than asked, and seldom farther."""

from __future__ import annotations

import numpy as np

from meshjig.extras.clearance import Room
from meshjig.extras.depth import Depth
from meshjig.mesh.halfedges import edges
from meshjig.mesh.intersections import crossing_faces
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.types import Floats, Ints

__all__ = ["cleared"]

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


def cleared(V: Floats, F: Ints, around: Depth, clearance: float) -> tuple[Floats, Ints]:
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
    room = Room(places, F, around, min(_SPACING * clearance, _YIELD * edge))
    V, gone = _given_way(V, np.zeros(len(V)), away, edge, clearance, room)
    G = F[(gone > 0)[F].any(axis=1)]
    room.look_at([G[:, corners] for corners in _ON_FACE])
    V, _ = _given_way(V, gone, away, edge, clearance, room)
    final = _uncrossed(V, first, F)
    room.update(final, (final != V).any(axis=1))
    return final, room.too_near(final, _LEFT * clearance)


def _given_way(
    V: Floats, gone: Floats, away: Floats, edge: float, clearance: float, room: Room
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
