"""Even triangles on the zero surface of a function, and on surfaces of revolution."""

import numpy as np

from meshjig.mesh.measure import unit
from tests.meshes import Shape

__all__ = ["either", "net", "revolved", "rounded"]

_ROUNDS = 8  # of smoothing, each followed by a step back to the surface
_CORNERS = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])


def net(value, low, high, cell):
    """Triangulate where a function is zero, by one vertex in every cube that the surface passes through.

    Corners of cubes are at whole multiples of the cell. No cube may hold two sheets.

    Parameters
    ----------
    value : function of (k, 3) points in mm that gives about the signed distance, (k,), negative inside
    low, high : (3,), mm, a box around the surface
    cell : mm, edge of a cube, about that of the triangles

    Returns
    -------
    Shape, facing outward
    """
    first = np.floor(np.array(low) / cell).astype(int) - 2
    ijk = np.indices(np.ceil(np.array(high) / cell).astype(int) + 3 - first)
    inside = value(cell * (ijk.reshape(3, -1).T + first)).reshape(ijk.shape[1:]) < 0
    n = np.array(inside.shape) - 1
    corners = sum(inside[i : i + n[0], j : j + n[1], k : k + n[2]].astype(int) for i, j, k in _CORNERS)
    met = (corners > 0) & (corners < 8)
    number = np.full(met.shape, -1)
    number[met] = np.arange(met.sum())
    quads = np.concatenate([_quads(inside, number, axis) for axis in range(3)])
    V = cell * (np.argwhere(met) + first + 0.5)
    E = np.unique(np.sort(np.stack([quads, np.roll(quads, -1, 1)], -1).reshape(-1, 2), 1), axis=0)
    degree = np.bincount(E.ravel(), minlength=len(V))[:, None]
    for _ in range(_ROUNDS):
        V = _on_zero(value, V, cell)
        middle = np.zeros_like(V)
        np.add.at(middle, E[:, 0], V[E[:, 1]])
        np.add.at(middle, E[:, 1], V[E[:, 0]])
        V = V + 0.6 * (middle / degree - V)
    for _ in range(3):
        V = _on_zero(value, V, cell)
    a, b, c, d = quads.T
    turn = (np.linalg.norm(V[b] - V[d], axis=1) < np.linalg.norm(V[a] - V[c], axis=1))[:, None]
    one = np.where(turn, np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    other = np.where(turn, np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return Shape(V, np.concatenate([one, other]))


def _quads(inside, number, axis):
    """Give the four cubes around each edge of the grid, along an axis, that crosses the surface."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    after = np.diff(inside.astype(int), axis=axis)
    at = np.argwhere(after)
    leaves = after[tuple(at.T)] > 0
    back = np.zeros((4, 3), int)
    back[1:3, u], back[2:4, v] = 1, 1
    around = number[tuple(np.moveaxis(at[:, None] - back, -1, 0))]
    return np.where(leaves[:, None], around[:, ::-1], around)


def _on_zero(value, V, cell):
    """Take points a Newton step towards the surface, at most half a cell."""
    h = 1e-3 * cell
    f = value(V)
    slope = np.stack([(value(V + h * axis) - value(V - h * axis)) / (2 * h) for axis in np.eye(3)], 1)
    size = np.linalg.norm(slope, axis=1)
    step = np.clip(f / np.maximum(size, 0.3), -cell / 2, cell / 2)
    return V - step[:, None] * unit(slope)


def revolved(profile, edge):
    """Turn a profile about z, with rings of as many points as their girth asks for.

    Parameters
    ----------
    profile : (k, 2), radius and height, mm, that starts and ends on the axis; outward is on its right
    edge : mm, about the length of all edges; that of the profile's own is given by its points
    """
    profile = np.asarray(profile, float)
    count = np.maximum(np.round(2 * np.pi * profile[:, 0] / edge).astype(int), 6)
    count[[0, -1]] = 1
    start = np.concatenate([[0], np.cumsum(count)])
    ring = np.repeat(np.arange(len(count)), count)
    angle = 2 * np.pi * (np.arange(start[-1]) - start[ring]) / count[ring]
    V = np.stack([profile[ring, 0] * np.cos(angle), profile[ring, 0] * np.sin(angle), profile[ring, 1]], 1)
    V[[0, -1], :2] = 0.0
    F = np.concatenate([_strip(*count[i : i + 2], *start[i : i + 2]) for i in range(len(count) - 1)])
    return Shape(V, F)


def _strip(n, m, a, b):
    """Fill the strip between a ring of n points, numbered from a, and the next one, of m points, from b."""
    s, t = (np.arange(n) + 0.5) / n, (np.arange(m) + 0.5) / m
    i, j = np.arange(n), np.arange(m)
    here = np.stack([a + i, a + (i + 1) % n, b + np.searchsorted(t, s, "left") % m], 1)
    there = np.stack([b + (j + 1) % m, b + j, a + np.searchsorted(s, t, "right") % n], 1)
    return np.concatenate([here[: n * (n > 1)], there[: m * (m > 1)]])


def rounded(a, b, radius):
    """Give the common part of two solids, its edge rounded."""
    return np.minimum(np.maximum(a, b), -radius) + np.hypot(
        np.maximum(a + radius, 0), np.maximum(b + radius, 0)
    )


def either(a, b, radius):
    """Give the union of two solids, with a fillet."""
    return -rounded(-a, -b, radius)
