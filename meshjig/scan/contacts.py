"""Draw bodies apart where they touch, so that their pieces don't."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import border_halfedges, edge_keys
from meshjig.mesh.measure import area_vectors, sums, unit
from meshjig.scan.close_points import are_distinct

__all__ = ["Contacts", "draw_apart"]

_FARTHEST = 3.0  # of half the distance: so far a vertex moves at most, however sharp its corner
_FLAT = 0.05  # of the largest eigenvalue: where planes tell so little, a vertex stays along that direction
_OPPOSED = 0.1  # length of a sum of unit normals: they cancel out


class Contacts(NamedTuple):
    """Bodies that touched, and now stand apart."""

    V: Floats  # (n, 3), mm
    n_vertices: int  # that have moved
    at: list[float]  # mm, one of the places; empty where nothing touched


def draw_apart(V: Floats, F: Ints, distance: float) -> Contacts:
    """Move vertices that stand in one place with another into their own body, by half a distance.

    A vertex on a wall moves behind the wall's plane, one on a shared edge or corner behind all faces around.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, closed where bodies touch, oriented outward
    distance : float, mm, between bodies afterwards; 0 leaves them touching

    Returns
    -------
    Contacts
    """
    none = Contacts(V, 0, [])
    if distance <= 0 or are_distinct(V):
        return none
    place = _places(V)
    touching = _touching(F, place)
    if not touching.any():
        return none
    moved = V.copy()
    moved[touching] += _inward(V, F, touching, _walls(V, F, touching, place), distance / 2)
    return Contacts(moved, int(touching.sum()), V[touching][0].tolist())


def _places(V: Floats) -> Ints:
    """Number the places where vertices are, (n,)."""
    order = np.lexsort(V.T)
    place = np.empty(len(V), np.int64)
    place[order] = np.cumsum(np.append(False, (np.diff(V[order], axis=0) != 0).any(1)))
    return place


def _touching(F: Ints, place: Ints) -> Bools:
    """Mark inner vertices that share their place with another inner one, (n,)."""
    inner = np.ones(len(place), bool)
    inner[F[border_halfedges(F) // 3]] = False
    return inner & (np.bincount(place[inner], minlength=len(place))[place] > 1)


def _walls(V: Floats, F: Ints, touching: Bools, place: Ints) -> Bools:
    """Mark faces that lie on those of another body: at an edge of both, their normals cancel out; (m,)."""
    some = np.flatnonzero(touching[F].all(1))
    ends = place[F[some]][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    _, edge, count = np.unique(edge_keys(ends, len(place)), return_inverse=True, return_counts=True)
    N = np.repeat(unit(area_vectors(V, F[some])), 3, axis=0)
    total = np.stack([sums(edge, N[:, k], len(count)) for k in range(3)], 1)
    opposed = (count > 1) & (np.linalg.norm(total, axis=1) < _OPPOSED)
    wall = np.zeros(len(F), bool)
    wall[some] = opposed[edge].reshape(-1, 3).any(1)
    return wall


def _inward(V: Floats, F: Ints, touching: Bools, wall: Bools, depth: float) -> Floats:
    """Give the step by which each touching vertex gets behind the planes around it, (t, 3), mm."""
    number = np.cumsum(touching) - 1
    on_wall = np.zeros(len(V), bool)
    on_wall[F[wall]] = True
    corner = np.flatnonzero(touching[F.ravel()])
    face, at = corner // 3, F.ravel()[corner]
    counted = wall[face] | ~on_wall[at]
    face, at = face[counted], number[at[counted]]
    N = unit(area_vectors(V, F)[face])
    n = int(touching.sum())
    A, b = np.zeros((n, 3, 3)), np.zeros((n, 3))
    np.add.at(A, at, N[:, :, None] * N[:, None, :])
    np.add.at(b, at, -depth * N)
    step = np.einsum("nij,nj->ni", np.linalg.pinv(A, rcond=_FLAT, hermitian=True), b)
    length = np.linalg.norm(step, axis=1, keepdims=True)
    return step * np.minimum(1.0, _FARTHEST * depth / np.maximum(length, 1e-300))
