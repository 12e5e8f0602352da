"""A strip of wall moved to both sides by half a gap: where its corners go, and where that can't be done."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import area_vectors, unit

__all__ = ["Offsets", "Strip", "mitered"]

_LEAST, _MOST = 0.985, 1.08  # distances of a side from its wall that pass for 1
_LONGEST = 1.2  # miters beyond this are replaced by round joints
_UPRIGHT = 0.5  # cosine between a triangle and its offset
_STEADY = 1e-3  # pull towards the plain normal where the normals leave a direction open
_SPECK = 3e-3  # mm, triangles lower than this may fold: booleans dissolve them

# the triangles of a quad; corners are 0 top, 1 bottom where it starts, 2 top, 3 bottom where it ends
_FALLING = [[0, 2, 3], [0, 3, 1]]
_RISING = [[0, 2, 1], [2, 3, 1]]


class Strip(NamedTuple):
    """Quads of wall, each split into two triangles."""

    corners: Floats  # (s, 4, 3), mm: top and bottom where a quad starts, top and bottom where it ends
    rising: Bools  # (s,), the diagonal leads from bottom to top, not from top to bottom
    after: Ints  # (s,), the quad that follows in the same line, or -1


class Offsets(NamedTuple):
    """How a strip is thickened."""

    moves: Floats  # (s, 4, 3), mm, from a corner to its place on the left side
    after: Ints  # (s,), the quad that follows without a break, or -1
    failed: Bools  # (s,), quads that can't be thickened by moving their corners


def mitered(strip: Strip, half: float) -> Offsets:
    """Find for every corner the vector that moves all triangles around it by the same distance.

    Parameters
    ----------
    strip : Strip
    half : float, mm

    Returns
    -------
    Offsets
        Joints that are too sharp, or beside which a triangle would fold, are broken.

    Notes
    -----
    A corner's normals n are solved for n . x = half by least squares; with up to three of them, as a strip
    has, the solution is exact where it is steady.
    """
    after = strip.after
    while True:  # each round breaks a joint at least
        vertex, X = _joined(strip, after)
        F = np.where(strip.rising[:, None, None], vertex[:, _RISING], vertex[:, _FALLING]).reshape(-1, 3)
        x, poor = _solved(X, F)
        large = _large(X, F)
        folded = np.asarray((large & _folded(X, F, x * half)).reshape(-1, 2).any(1))
        poor_end = np.asarray(poor[vertex[:, 2:]].any(1))
        broken = (after >= 0) & (poor_end | folded | folded[after])
        if not broken.any():
            break
        after = np.where(broken, -1, after)
    alone = np.asarray(after < 0)
    alone[after[after >= 0]] = False
    failed = folded | poor[vertex].any(1) | alone & ~large.reshape(-1, 2).all(1)
    return Offsets(half * x[vertex], after, np.asarray(failed))


def _joined(strip: Strip, after: Ints) -> tuple[Ints, Floats]:
    """Number the corners so that joined ends are one; (s, 4), and the points, (n, 3)."""
    s = len(after)
    start = np.full(s, -1)
    joined = np.flatnonzero(after >= 0)
    start[after[joined]] = joined
    free = np.flatnonzero(start < 0)
    start[free] = s + np.arange(len(free))
    end = np.arange(s)
    n = s + len(free)
    X = np.concatenate(
        [strip.corners[:, 2], strip.corners[free, 0], strip.corners[:, 3], strip.corners[free, 1]]
    )
    return np.stack([start, start + n, end, end + n], 1), X


def _solved(X: Floats, F: Ints) -> tuple[Floats, Bools]:
    """Give each vertex's offset for distance 1, (n, 3), and mark those that keep another distance, (n,)."""
    area = area_vectors(X, F)
    weight = np.repeat(np.maximum(np.linalg.norm(area, axis=1), 1e-9), 3)
    N, at, n = np.repeat(unit(area), 3, axis=0), F.ravel(), len(X)
    counts = weight > 1e-6
    entries = [np.bincount(at, weight * N[:, i] * N[:, j], n) for i in range(3) for j in range(3)]
    M = np.stack(entries, 1).reshape(-1, 3, 3)
    r = np.stack([np.bincount(at, weight * N[:, i], n) for i in range(3)], 1)
    pull = np.trace(M, axis1=1, axis2=2)[:, None] * _STEADY
    M[:, range(3), range(3)] += pull + 1e-30
    x = np.linalg.solve(M, (r + pull * unit(np.asarray(r, np.float64)))[:, :, None])[:, :, 0]
    least = np.ones(n)
    np.minimum.at(least, at[counts], np.einsum("ij,ij->i", N, x[at])[counts])
    x = x / np.clip(least, 0.7, 1)[:, None]
    distance = np.einsum("ij,ij->i", N, x[at])
    poor = np.linalg.norm(x, axis=1) > _LONGEST
    poor[at[counts & ((distance < _LEAST) | (distance > _MOST))]] = True
    return x, poor


def _folded(X: Floats, F: Ints, x: Floats) -> Bools:
    """Mark triangles whose offset, to either side, turns away from them, (m,)."""
    area = area_vectors(X, F)
    left, right = (unit(area_vectors(X + side, F)) for side in (x, -x))
    cosine = np.minimum(np.einsum("ij,ij->i", unit(area), left), np.einsum("ij,ij->i", unit(area), right))
    return np.asarray(cosine < _UPRIGHT)


def _large(X: Floats, F: Ints) -> Bools:
    """Mark triangles that are high enough to be seen, (m,)."""
    longest = np.linalg.norm(X[F] - X[F[:, [1, 2, 0]]], axis=2).max(1)
    return np.asarray(np.linalg.norm(area_vectors(X, F), axis=1) > _SPECK * longest)
