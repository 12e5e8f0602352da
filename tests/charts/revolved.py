"""Tubes made by revolving a profile about y, perhaps bent, and their faces."""

import numpy as np

__all__ = ["annulus", "bent", "cone", "holed", "limb", "pole", "revolved", "trumpet", "vase"]


def revolved(radius, height, around=60, closed=(False, False), turn=0.0):
    """Give V, F of rings of points; rows are turned against each other by a share of an edge."""
    radius, height = np.asarray(radius, float), np.asarray(height, float)
    rows = len(radius)
    angle = 2 * np.pi * (np.arange(around)[None] + turn * np.arange(rows)[:, None]) / around
    V = np.stack(
        [radius[:, None] * np.cos(angle), height[:, None] + 0 * angle, -radius[:, None] * np.sin(angle)], -1
    )
    i, j = (x.ravel() for x in np.meshgrid(np.arange(rows - 1), np.arange(around), indexing="ij"))
    a, b = i * around + j, i * around + (j + 1) % around
    F = [np.stack([a, b, b + around], 1), np.stack([a, b + around, a + around], 1)]
    V, one = V.reshape(-1, 3), np.arange(around)
    two, top = np.roll(one, -1), (rows - 1) * around
    if closed[0]:
        F.append(np.stack([np.full(around, len(V)), two, one], 1))
        V = np.vstack([V, [0, height[0], 0]])
    if closed[1]:
        F.append(np.stack([np.full(around, len(V)), top + one, top + two], 1))
        V = np.vstack([V, [0, height[-1], 0]])
    return V, np.vstack(F).astype(np.int64)


def pole(turn=0.0):
    """A straight tube, open: an isometric map is known."""
    return revolved(np.full(40, 15.0), np.linspace(0, 90, 40), turn=turn)


def cone():
    """An open tube whose girth changes by more than one ring takes."""
    return revolved(np.linspace(30, 9, 60), np.linspace(0, 100, 60))


def trumpet():
    """An open tube whose girth changes by a third: one ring, stretched."""
    t = np.linspace(0, 1, 40)
    return revolved(15 + 5 * t**2, 60 * t)


def vase():
    """Closed below by a flat bottom, open above, with a belly."""
    t = np.linspace(0, 1, 60)
    r, y = 18 + 20 * np.sin(np.pi * t) ** 1.5, 110 * t
    flat = np.linspace(1, 18, 12, endpoint=False)
    return revolved(np.append(flat, r), np.append(0 * flat, y), closed=(True, False))


def limb():
    """Closed at both ends by domes."""
    t = np.linspace(0, np.pi, 80)[1:-1]
    return revolved(14 * np.sin(t) ** 0.4, 60 - 60 * np.cos(t), 48, closed=(True, True))


def bent(mesh, radius=60.0):
    """Bend a tube along y to an arc in the plane z = 0."""
    V, F = mesh
    angle = V[:, 1] / radius
    reach = radius + V[:, 0]
    return np.stack([reach * np.cos(angle), reach * np.sin(angle), V[:, 2]], 1), F


def holed(mesh, at, radius):
    """Take the faces near a point away."""
    V, F = mesh
    F = F[np.linalg.norm(V[F].mean(1) - at, axis=1) > radius]
    kept, F = np.unique(F, return_inverse=True)
    return V[kept], F.reshape(-1, 3)


def annulus(n=24, rings=6):
    """A flat ring, open: a sheet with a hole, not a tube."""
    V, F = revolved(np.linspace(10, 30, rings), np.zeros(rings), n)
    return V, F[:, ::-1].copy()
