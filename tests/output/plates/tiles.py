"""Thin solids, flat and bent, as pieces of a puzzle are."""

import numpy as np

from tests.meshes import Shape

__all__ = ["bent", "turned"]


def bent(width, depth, bend_x=0.0, bend_y=0.0, thickness=2.0, n=24):
    """A rectangle of a paraboloid with curvatures (1/mm), whose upper side is the outer one."""
    x, y = np.meshgrid(np.linspace(-width / 2, width / 2, n), np.linspace(-depth / 2, depth / 2, n))
    upper = np.stack([x, y, -(bend_x * x**2 + bend_y * y**2) / 2], -1).reshape(-1, 3)
    normal = np.stack([bend_x * x, bend_y * y, np.ones_like(x)], -1).reshape(-1, 3)
    lower = upper - thickness * normal / np.linalg.norm(normal, axis=1, keepdims=True)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n - 1), np.arange(n - 1), indexing="ij"))
    a, b, c, d = i * n + j, i * n + j + 1, (i + 1) * n + j + 1, (i + 1) * n + j
    top = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    rim = np.concatenate(
        [np.arange(n), np.arange(2, n + 1) * n - 1, n * n - 2 - np.arange(n - 1), np.arange(n - 2, 0, -1) * n]
    )
    p, q = rim, np.roll(rim, -1)
    m = n * n
    walls = np.concatenate([np.stack([p, p + m, q], 1), np.stack([q, p + m, q + m], 1)])
    return Shape(np.concatenate([upper, lower]), np.concatenate([top, top[:, ::-1] + m, walls]))


def turned(shape, seed):
    """The shape in any position, and the rotation that took it there."""
    rng = np.random.default_rng(seed)
    R, _ = np.linalg.qr(rng.standard_normal((3, 3)))
    R *= np.sign(np.linalg.det(R))
    return Shape(shape.V @ R.T + rng.uniform(-100, 100, 3), shape.F), R
