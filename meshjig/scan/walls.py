"""Walls inside a solid: where bodies share a face, each gets its own."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, face_areas, sums
from meshjig.scan.sectors import sectors

__all__ = ["Walled", "double_walls"]

_EMPTY = 1e-9  # of an assembly's area^1.5: what bounds less volume is no room


class Walled(NamedTuple):
    """Faces of bodies that touch, each of which is closed by its own."""

    F: Ints  # (m', 3)
    n_walls: int  # faces that two bodies have shared
    n_turned: int  # faces that now turn their back to the solid, as all do


class _Rooms(NamedTuple):
    """The parts into which faces divide space; normals point to side 0 of a patch, side 1 is behind."""

    patch: Ints  # (m,), smooth parts of the surface between crowded edges
    room: Ints  # (2, p), the room at either side of each patch
    assembly: Ints  # (p,), patches that are connected over crowded edges
    volume: Floats  # (r,), of each room; the space around an assembly counts negative


def double_walls(V: Floats, F: Ints) -> Walled:
    """Give a face that has solid on both sides a second face, so that each body is closed by its own.

    What an assembly of faces encloses is solid where it borders on the outside; a room farther in is solid
    unless the faces around it turn their fronts to it, as those of a hollow do. Only what has an edge of more
    than two faces changes.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, coherent over edges of two faces; no face with a repeated corner, no two with equal ones

    Returns
    -------
    Walled
    """
    rooms = _rooms(V, F)
    if rooms is None:
        return Walled(F, 0, 0)
    solid = _solid(V, F, rooms)
    front, back = (solid[side] for side in rooms.room)
    wall = (front & back & (rooms.room[0] != rooms.room[1]))[rooms.patch]
    turned = (front & ~back)[rooms.patch]
    F = F.copy()
    F[turned] = F[turned][:, ::-1]
    return Walled(np.concatenate([F, F[wall][:, ::-1]]), int(wall.sum()), int(turned.sum()))


def _rooms(V: Floats, F: Ints) -> _Rooms | None:
    """Find the rooms between faces; None where no edge has more than two faces."""
    e = edges(F)
    if e.n_faces.max(initial=0) <= 2:
        return None
    n, patch = components(F, twin=e.twin)
    around = sectors(V, F, e, patch)
    here, beyond = around.halfedge // 3, around.halfedge[around.following] // 3
    # a forward face has its back before it and its front after it; a backward one the other way round
    after = 2 * patch[here] + ~around.forward
    before = 2 * patch[beyond] + around.forward[around.following]
    open_ = np.unique(patch[np.flatnonzero(e.n_faces[e.edge_of_halfedge] == 1) // 3])
    n_rooms, room = connected(
        2 * n, np.concatenate([after, 2 * open_]), np.concatenate([before, 2 * open_ + 1])
    )
    room = room.reshape(-1, 2).T
    cone = np.einsum("ij,ij->i", V[F[:, 0]] - V[F].mean((0, 1)), area_vectors(V, F)) / 6
    volume = sums(patch, cone, n)
    signed = sums(room[1], volume, n_rooms) - sums(room[0], volume, n_rooms)
    return _Rooms(patch, room, connected(n, patch[here], patch[beyond])[1], signed)


def _solid(V: Floats, F: Ints, rooms: _Rooms) -> Bools:
    """Tell which rooms are solid, (r,)."""
    area = sums(rooms.patch, face_areas(V, F), rooms.room.shape[1])
    n, front, back = len(rooms.volume), rooms.room[0], rooms.room[1]
    of_assembly = sums(rooms.assembly, area, int(rooms.assembly.max()) + 1)
    scale = np.zeros(n)
    np.maximum.at(scale, rooms.room.ravel(), np.tile(of_assembly[rooms.assembly] ** 1.5, 2))
    enclosed = rooms.volume > _EMPTY * scale
    outside = rooms.volume < -_EMPTY * scale
    at_outside = np.zeros(n, bool)
    at_outside[back[outside[front]]] = True
    at_outside[front[outside[back]]] = True
    behind = sums(back, area, n) >= sums(front, area, n)
    return enclosed & (at_outside | behind)
