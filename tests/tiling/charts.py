"""Flat charts to lay tilings on."""

from itertools import pairwise

import numpy as np

from meshjig.mesh.types import Atlas, Mesh


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


def cup(radius=25.0, height=60.0, n=120, rows=24, rings=12):
    """A cylinder, closed below by a disc: a ring chart, and a cap whose pole is at the plane's (0, -100)."""
    period = np.rint(2 * np.pi * radius * 256) / 256
    angle = 2 * np.pi * np.arange(n) / n
    out = np.stack([np.cos(angle), np.sin(angle)], 1)
    side = [np.column_stack([radius * out, np.full(n, z)]) for z in np.linspace(0, height, rows + 1)]
    floor = [np.column_stack([r * out, np.zeros(n)]) for r in np.linspace(radius, 0, rings + 1)[1:-1]]
    V = np.concatenate([*side, *floor, np.zeros((1, 3))])
    i, j = (x.ravel() for x in np.meshgrid(np.arange(rows), np.arange(n), indexing="ij"))
    a, b = i * n + j, i * n + (j + 1) % n
    wall = np.concatenate([np.stack([a, b, b + n], 1), np.stack([a, b + n, a + n], 1)])
    u = np.rint(period * np.arange(n + 1) / n * 2**18) / 2**18
    u[-1] = period
    ring_uv = np.stack(np.meshgrid(u, np.linspace(0, height, rows + 1)), -1).reshape(-1, 2)
    wide = wall // n * (n + 1) + wall % n
    ahead = np.isin(np.arange(3)[None], 1) | (np.arange(len(wall)) < len(a))[:, None] * np.array([0, 0, 1])
    wide += (ahead.astype(bool) & (wall % n == 0)) * n
    first = len(side) * n
    loop = [np.arange(n), *(first + k * n + np.arange(n) for k in range(rings - 1))]
    bottom = [
        np.concatenate([np.stack([p, q, q[turn]], 1), np.stack([p, q[turn], p[turn]], 1)])
        for p, q in pairwise(loop)
        for turn in [(np.arange(n) + 1) % n]
    ]
    last = loop[-1]
    bottom.append(np.stack([last, np.full(n, len(V) - 1), np.roll(last, -1)], 1))
    disc = np.concatenate(bottom)
    kept, rows_of = np.unique(disc, return_inverse=True)
    cap_uv = V[kept, :2] * [1, -1] + [0, -100]
    F_uv = np.concatenate([wide, rows_of.reshape(-1, 3) + len(ring_uv)])
    chart = np.repeat([0, 1], [len(wall), len(disc)])
    mesh = Mesh(V, np.concatenate([wall, disc]))
    return Atlas(mesh, np.concatenate([ring_uv, cap_uv]), F_uv, chart, {}, np.array([period, 0.0]))
