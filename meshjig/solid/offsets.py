"""A strip of wall moved to both sides by half a gap: where its corners go, and where that can't be done."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.measure import unit
from meshjig.types import Bools, Floats, Ints

__all__ = ["Offsets", "Strip", "mitered"]

_OVER = 1.08  # a side may stand off by this much more than asked
_UNDER = 0.985
_LONGEST = 1.2  # miters beyond this are replaced by round joints
_UPRIGHT = 0.5  # cosine between a triangle and its offset
_STEADY = 1e-3  # pull towards the plain normal where the normals leave a direction open
_SPECK = 3e-3  # mm, triangles lower than this fold unseen
_ROUNDS = 12


class Strip(NamedTuple):
    """Quads of wall, each given by its four corners and split from first[0] to last[1]."""

    first: tuple[Floats, Floats]  # (s, 3) each, mm, top and bottom where a quad starts
    last: tuple[Floats, Floats]  # top and bottom where it ends


class Offsets(NamedTuple):
    """How a strip is thickened; joint s leads from quad s to after[s]."""

    after: Ints  # (s,), the quad that follows without a break, or -1
    first: tuple[Floats, Floats]  # (s, 3) each, mm, from a corner to its place on the left side
    last: tuple[Floats, Floats]
    failed: Bools  # (s,), quads that can't be thickened by moving their corners


def mitered(strip: Strip, after: Ints, half: float) -> Offsets:
    """Find for every corner the vector that moves all triangles around it by the same distance.

    Parameters
    ----------
    strip : Strip
    after : (s,) int64, the quad that follows each, or -1; no quad follows two
    half : float, mm

    Returns
    -------
    Offsets
        Joints that are too sharp, or whose offset would fold, are broken.

    Notes
    -----
    A corner's normals n are solved for n . x = half by least squares; with up to three of them, as a smooth
    strip has, the solution is exact.
    """
    (ta, ba), (tb, bb) = strip
    upper, lower = np.cross(tb - ta, bb - ta), np.cross(bb - ta, ba - ta)
    height = [_heights(ta, tb, bb, upper), _heights(ta, ba, bb, lower)]
    normals = unit(upper), unit(lower)
    weight = np.linalg.norm(upper, axis=1), np.linalg.norm(lower, axis=1)
    for _ in range(_ROUNDS):
        slot, n = _slots(after)
        solve = _Solver(slot, n, normals, weight)
        x = solve.vectors()
        poor = solve.poor(x)
        folded = _folded(strip, slot, x * half, (upper, lower), height)
        bad = folded | poor[slot[0]] | poor[slot[1]]
        broken = (after >= 0) & (poor[slot[1]] | folded | folded[after])
        if not broken.any():
            break
        after = np.where(broken, -1, after)
    top, bottom = x[0] * half, x[1] * half
    return Offsets(after, (top[slot[0]], bottom[slot[0]]), (top[slot[1]], bottom[slot[1]]), bad)


def _slots(after: Ints) -> tuple[tuple[Ints, Ints], int]:
    """Number the ends of quads so that joined ends share a number; (start, end), and how many there are."""
    s = len(after)
    start = np.full(s, -1)
    joined = np.flatnonzero(after >= 0)
    start[after[joined]] = joined
    free = np.flatnonzero(start < 0)
    start[free] = s + np.arange(len(free))
    return (start, np.arange(s)), s + len(free)


class _Solver:
    """The corners' equations: which normals meet in which slot, at the top [0] and at the bottom [1]."""

    def __init__(
        self, slot: tuple[Ints, Ints], n: int, normals: tuple[Floats, Floats], weight: tuple[Floats, Floats]
    ) -> None:
        a, b = slot
        upper, lower = (np.arange(len(a)), np.arange(len(a)) + len(a))
        self._n = n
        self._slot = np.concatenate([a, b, a]), np.concatenate([b, a, b])
        self._row = np.concatenate([upper, upper, lower]), np.concatenate([upper, lower, lower])
        self._normal = np.concatenate(normals)
        self._weight = np.concatenate(weight)

    def vectors(self) -> Floats:
        """Give the offset vectors for distance 1, (2, n, 3)."""
        return np.stack([self._solved(k) for k in (0, 1)])

    def poor(self, x: Floats) -> Bools:
        """Mark slots that keep a distance other than 1 from one of their triangles, (n,)."""
        poor = (np.linalg.norm(x, axis=2) > _LONGEST).any(0)
        for k in (0, 1):
            distance, counts = self._distances(k, x[k])
            off = counts & ((distance < _UNDER) | (distance > _OVER))
            poor[self._slot[k][off]] = True
        return poor

    def _solved(self, k: int) -> Floats:
        slot, N = self._slot[k], self._normal[self._row[k]]
        w = np.maximum(self._weight[self._row[k]], 1e-9)
        entries = [w * N[:, i] * N[:, j] for i in range(3) for j in range(3)]
        M = np.stack([np.bincount(slot, e, self._n) for e in entries], 1).reshape(-1, 3, 3)
        r = np.stack([np.bincount(slot, w * N[:, i], self._n) for i in range(3)], 1)
        trace = np.trace(M, axis1=1, axis2=2)[:, None, None]
        pull = _STEADY * trace * np.eye(3)
        x = np.linalg.solve(M + pull + 1e-30 * np.eye(3), r[:, :, None] + pull @ unit(r)[:, :, None])[:, :, 0]
        distance, counts = self._distances(k, x)
        least = np.ones(self._n)
        np.minimum.at(least, slot[counts], distance[counts])
        return np.asarray(x / np.clip(least, 0.7, 1)[:, None])

    def _distances(self, k: int, x: Floats) -> tuple[Floats, Bools]:
        """Give how far each triangle moves at each corner, and whether the triangle is worth a look."""
        row = self._row[k]
        return np.einsum("ij,ij->i", self._normal[row], x[self._slot[k]]), self._weight[row] > 1e-6


def _folded(
    strip: Strip, slot: tuple[Ints, Ints], x: Floats, area: tuple[Floats, Floats], height: list[Floats]
) -> Bools:
    """Mark quads with a triangle whose offset, to either side, turns away from it."""
    (ta, ba), (tb, bb) = strip
    folded = np.zeros(len(ta), bool)
    for side in (1.0, -1.0):
        pa, pb = ta + side * x[0][slot[0]], tb + side * x[0][slot[1]]
        qa, qb = ba + side * x[1][slot[0]], bb + side * x[1][slot[1]]
        moved = np.cross(pb - pa, qb - pa), np.cross(qb - pa, qa - pa)
        for n, m, h in zip(area, moved, height, strict=True):
            cosine = np.einsum("ij,ij->i", unit(n), unit(m))
            folded |= (cosine < _UPRIGHT) & (h > _SPECK)
    return folded


def _heights(a: Floats, b: Floats, c: Floats, area: Floats) -> Floats:
    """Give the least height of triangles, (s,), mm."""
    longest = np.max([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    return np.asarray(np.linalg.norm(area, axis=1) / np.maximum(longest, 1e-300))
