"""Ear clipping of many polygons at once."""

import numpy as np

from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["clip_ears"]

FLAT = 1e-9  # an ear whose doubled area is a smaller part of its squared lengths is none
LARGE = 40  # larger polygons go to mapbox_earcut first
BATCH = 200_000  # corners handled at once


def clip_ears(P: Floats, first: Ints, size: Ints, *, thorough: bool = False) -> tuple[Ints, Ints, Ints]:
    """Triangulate polygons, the best-shaped ear first.

    Polygons may touch themselves at a corner, and have corners on straight sides.

    Parameters
    ----------
    P : (n, 2) float64, corners, counter-clockwise, polygon after polygon
    first, size : (c,) int64, where each polygon starts in P, and its number of corners
    thorough : bool, clip large polygons here too, which is slower and gives up later

    Returns
    -------
    T : (t, 3) int64, into P
    polygon : (t,) int64
    failed : (f,) int64, polygons without a valid triangulation, left out of T
    """
    parts, owners, failed = [], [], []
    for k in np.unique(size):
        members = np.flatnonzero(size == k)
        if k < 3:
            failed.append(members)
            continue
        corners = first[members][:, None] + np.arange(k)
        step = max(1, BATCH // int(k))
        for i in range(0, len(members), step):
            I = corners[i : i + step]  # noqa: E741
            T, bad = _large(P, I) if k > LARGE and not thorough else _clip(P, I)
            good = members[i : i + step][~bad]
            parts.append(T[~bad].reshape(-1, 3))
            owners.append(np.repeat(good, k - 2))
            failed.append(members[i : i + step][bad])
    if not parts:
        return (
            np.zeros((0, 3), np.int64),
            np.zeros(0, np.int64),
            np.sort(np.concatenate([*failed, []])).astype(int),
        )
    return np.concatenate(parts), np.concatenate(owners), np.sort(np.concatenate(failed))


def _clip(P: Floats, I: Ints) -> tuple[Ints, Bools]:  # noqa: E741
    """Clip polygons of one size k; (m, k - 2, 3) triangles and (m,) whether that failed."""
    m, k = I.shape
    out = np.empty((m, k - 2, 3), np.int64)
    fail = np.zeros(m, bool)
    x, y = P[I, 0], P[I, 1]
    rows = np.arange(m)
    for step in range(k - 3):
        score = _ear_scores(x, y)
        b = score.argmax(axis=1)
        fail |= score[rows, b] <= 0
        n = x.shape[1]
        out[:, step] = np.stack([I[rows, b - 1], I[rows, b], I[rows, (b + 1) % n]], 1)
        keep = np.ones((m, n), bool)
        keep[rows, b] = False
        I, x, y = (a[keep].reshape(m, n - 1) for a in (I, x, y))  # noqa: E741
    out[:, k - 3] = I
    return out, fail | (_shape(x, y)[0][:, 1] <= FLAT)


def _shape(x: Floats, y: Floats) -> tuple[Floats, tuple[Floats, ...]]:
    """Give the doubled area of each corner's ear over its squared lengths, and its sides."""
    px, py = np.roll(x, 1, 1), np.roll(y, 1, 1)
    nx, ny = np.roll(x, -1, 1), np.roll(y, -1, 1)
    ax, ay, bx, by, cx, cy = x - px, y - py, nx - x, ny - y, px - nx, py - ny
    lengths = ax * ax + ay * ay + bx * bx + by * by + cx * cx + cy * cy
    quality = (ax * by - ay * bx) / np.maximum(lengths, 1e-300)
    return quality, (ax, ay, bx, by, cx, cy, px, py, nx, ny, lengths)


def _ear_scores(x: Floats, y: Floats) -> Floats:
    """Rate the ears; one that holds another corner gets -1."""
    score, (ax, ay, bx, by, cx, cy, px, py, nx, ny, lengths) = _shape(x, y)
    blunt = score <= FLAT
    r, c = np.nonzero(blunt)  # only corners that are not sharp can lie in an ear
    if len(r):
        zx, zy = x[r, c][:, None], y[r, c][:, None]
        slack = -FLAT * lengths[r]
        inside = ax[r] * (zy - py[r]) - ay[r] * (zx - px[r]) >= slack
        inside &= bx[r] * (zy - y[r]) - by[r] * (zx - x[r]) >= slack
        inside &= cx[r] * (zy - ny[r]) - cy[r] * (zx - nx[r]) >= slack
        inside &= (zx != x[r]) | (zy != y[r])
        inside &= (zx != px[r]) | (zy != py[r])
        inside &= (zx != nx[r]) | (zy != ny[r])
        i, ear = np.nonzero(inside)
        score[r[i], ear] = -1
        score[r, c] = -1
    return score


def _large(P: Floats, I: Ints) -> tuple[Ints, Bools]:  # noqa: E741
    """Clip large polygons one by one."""
    import mapbox_earcut

    m, k = I.shape
    out = np.zeros((m, k - 2, 3), np.int64)
    fail = np.ones(m, bool)
    for i in range(m):
        T = (
            mapbox_earcut.triangulate_float64(P[I[i]], np.array([k], np.uint32))
            .reshape(-1, 3)
            .astype(np.int64)
        )
        if len(T) != k - 2:
            continue
        quality = _shape(P[I[i, T], 0], P[I[i, T], 1])[0][:, 1]
        fail[i] = (quality <= FLAT).any()
        out[i] = I[i, T]
    return out, fail
