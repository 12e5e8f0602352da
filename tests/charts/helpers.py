"""Truths about maps to the plane, worked out without the code under test."""

import numpy as np

from tests.meshes import cylinder

__all__ = ["all_turn_left", "corner_angles", "half_tube", "signed_areas", "unrolled_tube"]


def corner_angles(X, F):
    """Give the angles of every face in degrees, (m, 3), for X in the plane or in space."""
    P = X[F]
    u, v = np.roll(P, -1, 1) - P, np.roll(P, 1, 1) - P
    cosine = (u * v).sum(2) / np.linalg.norm(u, axis=2) / np.linalg.norm(v, axis=2)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def signed_areas(uv, F):
    (x, y), (z, w) = (uv[F[:, 1]] - uv[F[:, 0]]).T, (uv[F[:, 2]] - uv[F[:, 0]]).T
    return (x * w - y * z) / 2


def all_turn_left(uv, F):
    return bool((signed_areas(uv, F) > 0).all())


def half_tube(n=24, radius=20.0, length=60.0):
    """Bend a grid of n by n squares to half a tube: developable."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij"))
    angle = np.pi * i / n
    V = np.stack([radius * np.cos(angle), radius * np.sin(angle), length * j / n], 1)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)[None]).ravel()
    F = np.concatenate([np.stack([a, a + n + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + 1], 1)])
    return V, F.astype(np.int64)


def unrolled_tube(n=800):
    """Unroll a tube of radius 25 mm and height 100 mm, cut open along one line: V, F, uv, F_uv."""
    V, F = cylinder(n)
    turn = np.arctan2(V[F][..., 1], V[F][..., 0])
    turn = np.where(turn < turn.max(1, keepdims=True) - np.pi, turn + 2 * np.pi, turn)
    places = np.stack([25 * turn, V[F][..., 2]], -1).reshape(-1, 2)
    # so that both sides of the line are a period apart exactly
    uv, F_uv = np.unique(np.round(places * 2**10) / 2**10, axis=0, return_inverse=True)
    return V, F, uv, F_uv.reshape(-1, 3).astype(np.int64)
