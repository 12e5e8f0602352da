"""Bring segments onto a grid so that there they meet at shared points only.

References
----------
Hobby, "Practical Segment Intersection with Finite Precision Output", 1999 (snap rounding).
"""

from typing import NamedTuple

import numpy as np

from meshjig.cut.broad_phase import box_pairs, boxes
from meshjig.cut.predicates import orient
from meshjig.mesh.types import Bools, Ints

__all__ = ["Noded", "noded"]

ROUNDS = 100  # one or two are enough for outlines that were noded before


class Noded(NamedTuple):
    """Segments that meet at shared points only; some may be alike."""

    points: Ints  # (m, 2), in grid steps
    segments: Ints  # (l, 2), into points, none without length
    source: Ints  # (l,), the given segment that each is a part of, in its direction
    point: Ints  # (n,), where the given points went


def noded(points: Ints, segments: Ints, step: int) -> Noded:
    """Round segments to every step-th line of the grid that they are given on.

    Every point and crossing moves to the next grid point, and every segment that passes one of them
    by less than half a step is led over it. No point changes sides of a segment that way.

    Parameters
    ----------
    points : (n, 2) int64, from 0 to below 2^30
    segments : (k, 2) int64
    step : int
    """
    places, point = _distinct((points + step // 2) // step)
    S = point[segments]
    source = np.flatnonzero(S[:, 0] != S[:, 1])
    S, ends, settled = S[source], points[segments[source]], True
    for _ in range(ROUNDS):
        one, other = _neighbours(ends, step)
        s = np.concatenate([one, one, other, other])
        p = np.concatenate([S[other].T.ravel(), S[one].T.ravel()])
        passed = _passes(ends, S, places, step, s, p)
        if settled:  # a segment that still moves from point to point makes crossings that won't stay
            places, crossing, at = _with_crossings(ends, places, step, one, other)
            s, p = np.append(s, crossing), np.append(p, at)
            passed = np.append(passed, (S[crossing] != at[:, None]).all(axis=1))
        if passed.any():
            S, part = _split(ends, S, places * step, s[passed], p[passed])
            source = source[part]
        elif settled:
            break
        settled = not passed.any()
        ends, step = places[S], 1
    return Noded(places, S, source, point)


def _distinct(points: Ints) -> tuple[Ints, Ints]:
    """Give points without repeats, and where each went."""
    _, first, number = np.unique((points[:, 0] << 31) | points[:, 1], return_index=True, return_inverse=True)
    order = np.argsort(first)  # in the order they came in, so that known points keep their numbers
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return points[first[order]], rank[number]


def _neighbours(ends: Ints, step: int) -> tuple[Ints, Ints]:
    """List pairs of segments whose bounding boxes come within a step of each other."""
    low, high = ends.min(axis=1), ends.max(axis=1) + step
    size = int(max((high - low).max(axis=1).mean(), high.max() / 4000, 1)) if len(ends) else 1
    around = boxes(size, low, high)
    one, other = box_pairs(around, around)
    upper = np.flatnonzero(one < other)
    one, other = one[upper], other[upper]
    touch = (low[one] <= high[other]) & (low[other] <= high[one])
    touch = np.flatnonzero(touch[:, 0] & touch[:, 1])
    return one[touch], other[touch]


def _with_crossings(ends: Ints, places: Ints, step: int, one: Ints, other: Ints) -> tuple[Ints, Ints, Ints]:
    """Add the places next to proper crossings; list them with both segments that cross there."""
    (a, b), (c, d) = ends[one].swapaxes(0, 1), ends[other].swapaxes(0, 1)
    turn_a, turn_b = orient(c, d, a), orient(c, d, b)
    turn_c, turn_d = orient(a, b, c), orient(a, b, d)
    x = np.flatnonzero((np.sign(turn_a) * np.sign(turn_b) < 0) & (np.sign(turn_c) * np.sign(turn_d) < 0))
    if not len(x):
        return places, x, x
    along = turn_a[x] / (turn_a[x] - turn_b[x])
    crossed = np.rint((a[x] + along[:, None] * (b[x] - a[x])) / step).astype(np.int64)
    everything, number = _distinct(np.concatenate([places, crossed]))
    at = number[len(places) :]
    return everything, np.concatenate([one[x], other[x]]), np.concatenate([at, at])


def _passes(ends: Ints, S: Ints, places: Ints, step: int, s: Ints, p: Ints) -> Bools:
    """Tell whether segments run through the grid squares around places that are not their ends."""
    new = np.flatnonzero((S[s, 0] != p) & (S[s, 1] != p))
    a, b, q = ends[s[new], 0], ends[s[new], 1], places[p[new]] * step
    inside = (2 * q + step > 2 * np.minimum(a, b)) & (2 * q - step < 2 * np.maximum(a, b))
    close = 2 * np.abs(orient(a, b, q)) < step * np.abs(b - a).sum(axis=1)
    out = np.zeros(len(s), bool)
    out[new] = inside[:, 0] & inside[:, 1] & close
    return out


def _split(ends: Ints, S: Ints, at: Ints, s: Ints, p: Ints) -> tuple[Ints, Ints]:
    """Lead segments s over places p; give the parts of all segments, and which each is a part of."""
    k = np.arange(len(S))
    nowhere, beyond = np.full(len(S), -np.inf), np.full(len(S), np.inf)
    a, d = ends[s, 0], ends[s, 1] - ends[s, 0]
    along = np.concatenate([nowhere, np.einsum("ij,ij->i", at[p] - a, d), beyond])
    s, p = np.concatenate([k, s, k]), np.concatenate([S[:, 0], p, S[:, 1]])
    order = np.lexsort((p, along, s))
    s, p = s[order], p[order]
    parts = np.flatnonzero((s[1:] == s[:-1]) & (p[1:] != p[:-1]))
    return np.stack([p[parts], p[parts + 1]], 1), s[parts]
