"""The walls between pieces as strips of quads, somewhat larger than the walls themselves."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import border_halfedges, next_halfedge
from meshjig.mesh.measure import area_vectors, unit
from meshjig.solid.border_chains import Chains, simplified
from meshjig.solid.offsets import Strip

__all__ = ["most_bend", "wall_strip"]

_TOLERANCE = 0.02  # mm
_LEAST_BEYOND, _MOST_BEYOND = 0.3, 1.0  # mm, that a wall is extended past a sheet
_MARGIN = 0.1  # mm


def most_bend(clearance: float) -> float:
    """Say how far a quad's diagonal may lie from the wall that it stands for, mm.

    With the tolerance of simplifying it stays well under half the gap, so that slabs cover their wall.
    """
    return clearance / 5


def wall_strip(
    V: Floats, D: Floats, F: Ints, chains: Chains, clearance: float, past: Floats | None = None
) -> tuple[Strip, Ints]:
    """Lay quads along borders, as few as their shape allows, and some way beyond the surface.

    Parameters
    ----------
    V : (n, 3) float64, mm
    D : (n, 3) float64, mm, from the top of the wall to its bottom
    F : (m, 3) int64
    chains : Chains
    clearance : float, mm
    past : (n,) float64, mm, optional
        How far walls go past the borders of an open surface; the clearance where it is not given.

    Returns
    -------
    strip : Strip
        It goes past both sheets, farther where they are slanted, and past the borders of an open surface.
    line : (s,) int64, the line of each quad
    """
    at, line = _kept(V, D, chains, clearance)
    beyond = [_beyond(X, D, F, chains, at, clearance) for X in (V, V + D)]
    past = np.full(len(V), clearance) if past is None else past
    at, line, shift = _past_open_ends(V, F, chains.vertex, at, line, past)
    v = chains.vertex[at]
    X, Y, u = V[v] + shift, V[v] + D[v] + shift, unit(D[v])
    top, bottom = X - beyond[0][at, None] * u, Y + beyond[1][at, None] * u
    a = np.flatnonzero(line[1:] == line[:-1])
    b = a + 1
    corners = np.stack([top[a], bottom[a], top[b], bottom[b]], 1)
    rising = np.linalg.norm(X[b] - Y[a], axis=1) < np.linalg.norm(X[a] - Y[b], axis=1)
    return Strip(corners, rising, _after(line[a], v[a], v[b])), line[a]


def _kept(V: Floats, D: Floats, chains: Chains, clearance: float) -> tuple[Ints, Ints]:
    """Give the rows of chains.vertex to keep, and their lines."""
    X, limit = V[chains.vertex], min(_TOLERANCE, clearance / 8)
    kept = np.flatnonzero(simplified(X, X + D[chains.vertex], chains.start, limit, most_bend(clearance)))
    return kept, np.searchsorted(chains.start, kept, side="right") - 1


def _beyond(X: Floats, D: Floats, F: Ints, chains: Chains, at: Ints, clearance: float) -> Floats:
    """Give how far a wall must go past sheet X so that the gap leaves nothing at its end, mm.

    By rows of chains.vertex; what holds between two kept rows holds for them.
    """
    touched = np.zeros(len(X), bool)
    touched[chains.vertex] = True
    near = F[touched[F].any(1)]
    N = unit(area_vectors(X, near))
    upright = np.ones(len(X))
    for k in range(3):
        v = near[:, k]
        np.minimum.at(upright, v, -np.einsum("ij,ij->i", N, unit(D[v])))
    upright = np.clip(upright, 0.05, 1.0)
    slope = np.sqrt(1 - upright**2) / upright
    wanted = np.clip(_MARGIN + slope * clearance / 2, max(_LEAST_BEYOND, 1.5 * clearance), _MOST_BEYOND)
    length = wanted[chains.vertex]
    between = np.maximum.reduceat(length, at)
    length[at] = np.maximum(between, np.append(between[0], between[:-1]))
    return length


def _past_open_ends(
    V: Floats, F: Ints, vertex: Ints, at: Ints, line: Ints, reach: Floats
) -> tuple[Ints, Ints, Floats]:
    """Lead lines that end on the border of an open surface on into the open; rows, lines, and the way on.

    Without it the corners of two pieces come too near to each other around the end of their wall, where the
    border of the surface is a notch.
    """
    outward = _outward(V, F)
    end = np.append(line[1:] != line[:-1], True)
    start = np.append(True, end[:-1])
    ring = vertex[at[start]] == vertex[at[end]]
    leads = (outward[vertex[at]] != 0).any(1) & ~ring[line]
    last, first = np.flatnonzero(end & leads), np.flatnonzero(start & leads)
    row = np.concatenate([last, first])  # last before first: both may go to the same place
    place = np.concatenate([last + 1, first])
    v = vertex[at[row]]
    shift = np.insert(np.zeros((len(at), 3)), place, reach[v, None] * outward[v], axis=0)
    return np.insert(at, place, at[row]), np.insert(line, place, line[row]), shift


def _outward(V: Floats, F: Ints) -> Floats:
    """Give the directions that lead off an open surface at its border, (n, 3); 0 elsewhere."""
    h = border_halfedges(F)
    a, b = F.ravel()[h], F.ravel()[next_halfedge(h)]
    away = unit(np.cross(V[b] - V[a], area_vectors(V, F[h // 3])))
    total = np.zeros_like(V)
    np.add.at(total, a, away)
    np.add.at(total, b, away)
    return unit(total)


def _after(line: Ints, first: Ints, last: Ints) -> Ints:
    """Give the quad that follows each, or -1; the last of a ring is followed by its first."""
    after = np.append(np.where(line[1:] == line[:-1], np.arange(1, len(line)), -1), -1)
    start = np.searchsorted(line, np.arange(line[-1] + 1))
    end = np.append(start[1:], len(line)) - 1
    ring = first[start] == last[end]
    after[end[ring]] = start[ring]
    return after
