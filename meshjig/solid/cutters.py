"""The bodies that take the gap out of the pieces: closed slabs around strips of wall, with round ends."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.booleans import Body, body, sound
from meshjig.mesh.chains import follow
from meshjig.mesh.measure import unit
from meshjig.solid.offsets import Offsets, Strip, mitered

__all__ = ["ball", "cutters", "round_cutters", "slabs"]

_CAP = np.radians([67.5, 22.5, -22.5, -67.5])  # corners of an octagon around the end, sides along the wall
_RING = np.pi / 4 * np.arange(8) + np.pi / 8  # corners of an octagon with a side towards 0


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
        rows, moves = (
            np.concatenate([x[quads, :2], x[quads[-1:], 2:]]) for x in (strip.corners, offsets.moves)
        )
        made.append((quads, *_slab(rows, moves, strip.rising[quads], half, closed)))
    return made


def _runs(offsets: Offsets) -> list[tuple[Ints, bool]]:
    """List the quads of every run, and whether it is a ring."""
    after = offsets.after
    follows = np.zeros(len(after), bool)
    follows[after[after >= 0]] = True
    runs, taken, following = [], offsets.failed.tolist(), after.tolist()
    for s in [*np.flatnonzero(~follows).tolist(), *range(len(after))]:
        if taken[s]:
            continue
        run = follow(following, s, set())
        for q in run:
            taken[q] = True
        runs.append((np.array(run), following[run[-1]] >= 0))
    return runs


def _slab(rows: Floats, moves: Floats, rising: Bools, half: float, closed: bool) -> tuple[Floats, Ints]:
    """Give the mesh around one run; rows (k + 1, 2, 3) are its points at the top and at the bottom."""
    n = len(rows) - closed
    left, right = rows[:n] + moves[:n], rows[:n] - moves[:n]
    V = np.concatenate([left[:, 0], right[:, 0], left[:, 1], right[:, 1]])
    i = np.arange(len(rising))
    ends = np.stack([i, (i + 1) % n], 1)
    tl, tr, bl, br = ends, ends + n, ends + 2 * n, ends + 3 * n
    level = np.zeros(len(i), bool)
    F = np.concatenate(
        [_quads(tr, tl, level), _quads(bl, br, level), _quads(tl, bl, rising), _quads(br, tr, ~rising)]
    )
    if closed:
        return V, F
    over, under, caps = [], [], []
    for end in (0, 1):
        caps.append(_cap(rows, moves, half, end))
        at, first = end * (n - 1), 4 * n + 8 * end
        ring = np.array([[at, *range(first, first + 4), n + at]])
        low = np.array([[2 * n + at, *range(first + 4, first + 8), 3 * n + at]])
        if not end:
            ring, low = ring[:, ::-1], low[:, ::-1]
        over.append(ring)
        under.append(low)
    F = np.concatenate([F, *(_lid(o, u) for o, u in zip(over, under, strict=True))])
    return np.concatenate([V, *caps]), F


def _quads(x: Ints, y: Ints, rising: Bools) -> Ints:
    """Give two triangles for each quad between x and y (k, 2); rising: the diagonal ends at x[:, 1]."""
    (a, b), (c, d) = x.T, y.T
    first = np.stack([a, b, np.where(rising, c, d)], 1)
    second = np.stack([np.where(rising, b, a), d, c], 1)
    return np.concatenate([first, second])


def _cap(rows: Floats, moves: Floats, half: float, end: int) -> Floats:
    """Give the points around one end, left to right, four at the top and four at the bottom."""
    points, left = rows[-end], unit(moves[-end])
    axis = unit(points[0] - points[1])
    ahead = unit(np.cross(left, axis)) * (1 if end else -1)
    radius = half / np.cos(np.radians(22.5))
    around = np.cos(_CAP)[:, None] * ahead[:, None] + np.sin(_CAP)[:, None] * left[:, None]
    return np.asarray((points[:, None] + radius * around).reshape(-1, 3))


def _lid(over: Ints, under: Ints) -> Ints:
    """Give the faces of a round end between rings of six points (1, 6), clockwise seen from above."""
    o, u = over[0], under[0]
    m = np.arange(1, 5)
    top = np.stack([np.full(4, o[0]), o[m + 1], o[m]], 1)
    bottom = np.stack([np.full(4, u[0]), u[m], u[m + 1]], 1)
    sides = _quads(np.stack([o[:-1], o[1:]], 1), np.stack([u[:-1], u[1:]], 1), np.zeros(5, bool))
    return np.concatenate([top, bottom, sides])


def cutters(strip: Strip, offsets: Offsets, half: float) -> list[tuple[Ints, Body]]:
    """Thicken walls to bodies as wide as the gap: long slabs, and hulls of what can't be made one.

    Parameters
    ----------
    strip : Strip
    offsets : Offsets
    half : float, mm

    Returns
    -------
    list of (quads (k,) int64, body); every quad is in one of them
    """
    made: list[tuple[Ints, Any]] = []
    left = np.flatnonzero(offsets.failed).tolist()
    for quads, V, F in slabs(strip, offsets, half):
        slab = body(V, F)
        if sound(slab):
            made.append((quads, slab))
        else:
            left += quads.tolist()
    return made + [(np.array([s]), _hull(strip.corners[s], half)) for s in left]


def round_cutters(strip: Strip, quads: Ints, half: float) -> list[Body]:
    """Thicken quads one by one, for a slab that turned out to cross itself."""
    if len(quads) == 1:
        return [_hull(strip.corners[quads[0]], half)]
    alone = Strip(strip.corners[quads], strip.rising[quads], np.full(len(quads), -1))
    return [cutter for _, cutter in cutters(alone, mitered(alone, half), half)]


def _hull(corners: Floats, half: float) -> Body:
    """Give the convex hull of two prisms, along the ends of a quad and wide enough for its gap."""
    import manifold3d

    first, last = corners[0] - corners[1], corners[2] - corners[3]
    across = np.cross(corners[2] - corners[0] + corners[3] - corners[1], first + last)
    points = []
    for top, bottom in corners.reshape(2, 2, 3):
        axis = unit(top - bottom)
        side = unit(across - (across @ axis) * axis)
        if not side.any():
            side = unit(np.cross(axis, np.eye(3)[np.abs(axis).argmin()]))
        ring = np.cos(_RING)[:, None] * side + np.sin(_RING)[:, None] * np.cross(axis, side)
        points += [top + half / np.cos(np.pi / 8) * ring, bottom + half / np.cos(np.pi / 8) * ring]
    return manifold3d.Manifold.hull_points(np.concatenate(points))


def ball() -> Floats:
    """Give the corners of an icosahedron around the unit ball, (12, 3)."""
    g = (1 + np.sqrt(5)) / 2
    points = np.array([[0, a, b * g] for a in (-1, 1) for b in (-1, 1)], float)
    points = np.concatenate([points, np.roll(points, 1, 1), np.roll(points, 2, 1)])
    return points * np.sqrt(3) / g**2
