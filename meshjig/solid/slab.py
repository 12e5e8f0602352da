"""Closed slabs around strips of wall, with round ends."""

from __future__ import annotations

import numpy as np

from meshjig.measure import unit
from meshjig.solid.offsets import Offsets, Strip
from meshjig.types import Floats, Ints

__all__ = ["slabs"]

_CAP = np.radians([67.5, 22.5, -22.5, -67.5])  # an octagon around the end, sides along the wall


def slabs(strip: Strip, offsets: Offsets, half: float) -> list[tuple[Ints, Floats, Ints]]:
    """Thicken every run of joined quads to a closed mesh.

    Parameters
    ----------
    strip : Strip
    offsets : Offsets; quads that failed are left out
    half : float, mm, the radius of round ends

    Returns
    -------
    list of (quads (k,) int64, V (n, 3) float64, F (m, 3) int64)
        The quads in their order along the slab; faces outward.
    """
    made = []
    for quads, closed in _runs(offsets):
        s = slice(quads[0], quads[-1] + 1) if _consecutive(quads) else quads
        rows = [
            np.concatenate([first[s], last[quads[-1:]]])
            for first, last in zip(strip.first, strip.last, strict=True)
        ]
        moves = [
            np.concatenate([first[s], last[quads[-1:]]])
            for first, last in zip(offsets.first, offsets.last, strict=True)
        ]
        made.append((quads, *_slab(rows, moves, half, closed)))
    return made


def _consecutive(quads: Ints) -> bool:
    return bool(quads[-1] - quads[0] + 1 == len(quads))


def _runs(offsets: Offsets) -> list[tuple[Ints, bool]]:
    """List the quads of every run, and whether it is a ring."""
    after = np.where(offsets.failed, -1, offsets.after)
    follower = np.zeros(len(after), bool)
    follower[after[after >= 0]] = True
    runs, taken = [], offsets.failed.copy()
    following = after.tolist()
    for s in [*np.flatnonzero(~follower).tolist(), *range(len(after))]:
        if taken[s]:
            continue
        run = [s]
        while (s := following[s]) >= 0 and s != run[0]:
            run.append(s)
        taken[run] = True
        runs.append((np.array(run), s >= 0))
    return runs


def _slab(rows: list[Floats], moves: list[Floats], half: float, closed: bool) -> tuple[Floats, Ints]:
    """Give the mesh around one run; rows are its points at the top and at the bottom."""
    (top, bottom), (up, down) = rows, moves
    n = len(top) - closed
    V = np.concatenate([top[:n] + up[:n], top[:n] - up[:n], bottom[:n] + down[:n], bottom[:n] - down[:n]])
    i = np.arange(len(top) - 1)
    j = (i + 1) % n
    tl, tr, bl, br = (np.stack([i, j], 1) + k * n for k in range(4))
    F = np.concatenate([_quads(tr, tl), _quads(bl, br), _quads(tl, bl), _quads(br, tr, turned=True)])
    if closed:
        return V, F
    caps = [_cap(rows, moves, half, n, end) for end in (0, 1)]
    V = np.concatenate([V, caps[0][0], caps[1][0]])
    return V, np.concatenate([F, caps[0][1], caps[1][1] + np.where(caps[1][1] >= 4 * n, 8, 0)])


def _quads(x: Ints, y: Ints, turned: bool = False) -> Ints:
    """Give two triangles for each quad between x (k, 2) and y (k, 2)."""
    if turned:
        return np.concatenate(
            [np.stack([x[:, 0], x[:, 1], y[:, 0]], 1), np.stack([x[:, 1], y[:, 1], y[:, 0]], 1)]
        )
    return np.concatenate(
        [np.stack([x[:, 0], x[:, 1], y[:, 1]], 1), np.stack([x[:, 0], y[:, 1], y[:, 0]], 1)]
    )


def _cap(rows: list[Floats], moves: list[Floats], half: float, n: int, end: int) -> tuple[Floats, Ints]:
    """Give the eight points and the faces that close a slab at its start or end."""
    k = -1 if end else 0
    axis = unit(rows[0][k] - rows[1][k])
    radius = half / np.cos(np.radians(22.5))
    points = []
    for row, move in zip(rows, moves, strict=True):
        left = unit(move[k])
        ahead = unit(np.cross(left, axis)) * (1 if end else -1)
        points.append(row[k] + radius * (np.cos(_CAP)[:, None] * ahead + np.sin(_CAP)[:, None] * left))
    at = n - 1 if end else 0
    over = np.array([at, *range(4 * n, 4 * n + 4), n + at])
    under = np.array([2 * n + at, *range(4 * n + 4, 4 * n + 8), 3 * n + at])
    m = np.arange(1, 5)
    lids = [
        np.stack([np.full(4, over[0]), over[m + 1], over[m]], 1),
        np.stack([np.full(4, under[0]), under[m], under[m + 1]], 1),
    ]
    sides = _quads(np.stack([over[:-1], over[1:]], 1), np.stack([under[:-1], under[1:]], 1))
    F = np.concatenate([*lids, sides])
    return np.concatenate(points), F if end else F[:, ::-1]
