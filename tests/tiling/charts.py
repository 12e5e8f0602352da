"""Flat charts to lay tilings on."""

import numpy as np

from meshjig.types import Atlas, Mesh


def flat_chart(n=40, size=100.0, corner_cut=False, angle=0.0, width=1.0):
    """A rectangular sheet, or one without its upper right quarter, turned by degrees."""
    x = np.linspace(0, size, n + 1)
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    keep = ~((i >= n / 2) & (j >= n / 2)) if corner_cut else np.ones_like(i, bool)
    a = (i * (n + 1) + j)[keep]
    F = np.concatenate([np.stack([a, a + n + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + 1], 1)])
    uv = np.stack(np.meshgrid(x * width, x, indexing="ij"), -1).reshape(-1, 2)
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    uv = uv @ np.array([[c, s], [-s, c]])
    used, F = np.unique(F, return_inverse=True)
    F, uv = F.reshape(-1, 3), uv[used]
    return Atlas(Mesh(np.c_[uv, np.zeros(len(uv))], F), uv, F, np.zeros(len(F), np.int64))


def ring_chart(period=157.0, height=80.0, wiggle=6.0, n=60, m=30):
    """The side of a cylinder, cut open along a line that swings from side to side."""
    u, v = np.arange(n) / n * period, np.arange(m + 1) / m * height
    U, W = np.meshgrid(u, v, indexing="ij")
    uv = np.rint(np.stack([U + wiggle * np.sin(7 * W / height), W], -1) * 2**18) / 2**18
    uv = np.concatenate([uv, uv[:1] + np.array([period, 0.0])]).reshape(-1, 2)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    a, b = i * (m + 1) + j, (i + 1) * (m + 1) + j
    F_uv = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    turn = 2 * np.pi / period * uv[: n * (m + 1), 0]
    radius = period / (2 * np.pi)
    V = np.stack([radius * np.cos(turn), radius * np.sin(turn), uv[: n * (m + 1), 1]], 1)
    F = F_uv % (n * (m + 1))
    return Atlas(Mesh(V, F), uv, F_uv, np.zeros(len(F), np.int64), {}, np.array([period]))
