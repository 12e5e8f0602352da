"""Small pieces whose gaps, overlaps and thicknesses are known from their making."""

import numpy as np

from meshjig.mesh.halfedges import border_halfedges, next_halfedge
from tests.meshes import Shape, half_sphere

__all__ = ["box", "folded_plate", "hemisphere_shells", "shell", "turned"]


def box(low, high, n=4):
    """Make a closed box, each side a grid of n x n squares."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij"))
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = (x.ravel() for x in (k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]))
    grid = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    V, F = [], []
    for axis in range(3):
        for side in (0, n):
            corner = np.empty((len(i), 3), np.int64)
            corner[:, axis], corner[:, (axis + 1) % 3], corner[:, (axis + 2) % 3] = side, i, j
            F.append((grid if side else grid[:, ::-1]) + len(V) * len(i))
            V.append(corner)
    lattice, inverse = np.unique(np.concatenate(V), axis=0, return_inverse=True)
    return Shape(low + lattice / n * (high - low), inverse.ravel()[np.concatenate(F)])


def shell(outer, inner, F):
    """Close two sheets with the same faces by walls along their border."""
    n = len(outer)
    h = border_halfedges(F)
    a, b = F.ravel()[h], F.ravel()[next_halfedge(h)]
    walls = np.concatenate([np.stack([b, a, a + n], 1), np.stack([b, a + n, b + n], 1)])
    return Shape(np.concatenate([outer, inner]), np.concatenate([F, F[:, ::-1] + n, walls]))


def hemisphere_shells(radius, thickness, gap):
    """Make the two halves of a hollow sphere, with a gap between their rims."""
    dome, F = half_sphere(8000)
    unit = dome / np.linalg.norm(dome, axis=1, keepdims=True)
    V, F = shell(radius * unit, (radius - thickness) * unit, F)
    lift = np.array([0, 0, gap / 2])
    return [Shape(V + lift, F), Shape((V + lift) * [1, 1, -1], F[:, ::-1])]


def folded_plate(n=60, m=10):
    """Make a plate whose lower sheet runs back through itself: closed, oriented, of positive volume."""
    u = np.linspace(0, 4 * np.pi, n)
    upper = np.stack(np.broadcast_arrays(u[:, None], np.linspace(0, 5, m)[None], np.zeros(())), -1).reshape(
        -1, 3
    )
    loop = np.stack([u - 2 * np.sin(u), np.zeros(n), -2 - np.cos(u)], 1)
    lower = np.repeat(loop, m, axis=0) + upper * [0, 1, 0]
    k = np.arange(n * m).reshape(n, m)
    a, b, c, d = (x.ravel() for x in (k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]))
    return shell(upper, lower, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


def turned(piece, seed):
    """Move a piece rigidly, to where no face is parallel to an axis."""
    rng = np.random.default_rng(seed)
    Q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    Q *= np.sign(np.linalg.det(Q))
    return Shape(piece[0] @ Q.T + rng.normal(size=3) * 30, piece[1])
