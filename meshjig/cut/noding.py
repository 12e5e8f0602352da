"""Make segments on a grid meet at shared points only, whatever they did before.

References
----------
Hobby, "Practical Segment Intersection with Finite Precision Output", 1999 (snap rounding).
"""

import numpy as np

from meshjig.cut.broad_phase import box_pairs, boxes
from meshjig.cut.predicates import orient
from meshjig.types import Ints

__all__ = ["noded"]

ROUNDS = 100  # one or two are enough for outlines that were noded before


def noded(points: Ints, segments: Ints) -> tuple[Ints, Ints, Ints]:
    """Split segments where they cross, and where they pass a point by less than half a grid step.

    Parameters
    ----------
    points : (n, 2) int64, distinct, below 2^25
    segments : (k, 2) int64

    Returns
    -------
    points : (m, 2) int64, the given ones first
    segments : (l, 2) int64, not of zero length; some may be alike
    source : (l,) int64, the given segment that each is a part of, in its direction
    """
    source = np.arange(len(segments))
    settled = True
    for _ in range(ROUNDS):
        one, other = _neighbours(points, segments)
        s = np.concatenate([one, one, other, other])
        p = np.concatenate([segments[other].T.ravel(), segments[one].T.ravel()])
        if settled:  # a segment that still moves from point to point makes crossings that won't stay
            points, crossing, at = _with_crossings(points, segments, one, other)
            s, p = np.append(s, crossing), np.append(p, at)
        passed = _passes(points, segments, s, p)
        if passed.any():
            segments, part = _split(points, segments, s[passed], p[passed])
            source = source[part]
        elif settled:
            break
        settled = not passed.any()
    return points, segments, source


def _neighbours(points: Ints, segments: Ints) -> tuple[Ints, Ints]:
    """List pairs of segments whose bounding boxes touch, without those that just share an end."""
    a, b = points[segments[:, 0]], points[segments[:, 1]]
    low, high = np.minimum(a, b), np.maximum(a, b)
    size = int(max((high - low).max(axis=1).mean(), high.max() / 4000, 1)) if len(a) else 1
    around = boxes(size, low, high)
    one, other = box_pairs(around, around)
    upper = np.flatnonzero(one < other)
    one, other = one[upper], other[upper]
    touch = np.flatnonzero(((low[one] <= high[other]) & (low[other] <= high[one])).all(axis=1))
    one, other = one[touch], other[touch]
    # bounding boxes that share a corner only do so at a shared end
    overlap = np.minimum(high[one], high[other]) - np.maximum(low[one], low[other])
    shared = (segments[one][:, :, None] == segments[other][:, None, :]).any(axis=(1, 2))
    keep = np.flatnonzero(~(shared & (overlap == 0).all(axis=1)))
    return one[keep], other[keep]


def _with_crossings(points: Ints, segments: Ints, one: Ints, other: Ints) -> tuple[Ints, Ints, Ints]:
    """Add the grid points next to proper crossings; list them with both segments that cross there."""
    a, b = points[segments[one, 0]], points[segments[one, 1]]
    c, d = points[segments[other, 0]], points[segments[other, 1]]
    turn_a, turn_b = orient(c, d, a), orient(c, d, b)
    turn_c, turn_d = orient(a, b, c), orient(a, b, d)
    x = np.flatnonzero((np.sign(turn_a) * np.sign(turn_b) < 0) & (np.sign(turn_c) * np.sign(turn_d) < 0))
    if not len(x):
        return points, x, x
    along = turn_a[x] / (turn_a[x] - turn_b[x])
    place = np.rint(a[x] + along[:, None] * (b[x] - a[x])).astype(np.int64)
    everything = np.concatenate([points, place])
    key = (everything[:, 0] << 31) | everything[:, 1]
    _, first, number = np.unique(key, return_index=True, return_inverse=True)
    new = np.sort(first[first >= len(points)])
    place_of = np.arange(len(everything))
    place_of[new] = len(points) + np.arange(len(new))
    at = place_of[first[number[len(points) :]]]
    return (
        np.concatenate([points, everything[new]]),
        np.concatenate([one[x], other[x]]),
        np.concatenate([at, at]),
    )


def _passes(points: Ints, segments: Ints, s: Ints, p: Ints) -> Ints:
    """Tell whether segments run through the grid squares around points that are not their ends."""
    a, b, q = points[segments[s, 0]], points[segments[s, 1]], points[p]
    inside = ((q >= np.minimum(a, b)) & (q <= np.maximum(a, b))).all(axis=1)
    close = 2 * np.abs(orient(a, b, q)) <= np.abs(b - a).sum(axis=1)
    return inside & close & (segments[s, 0] != p) & (segments[s, 1] != p)


def _split(points: Ints, segments: Ints, s: Ints, p: Ints) -> tuple[Ints, Ints]:
    """Lead segments s over points p; give the parts of all segments, and which each is a part of."""
    k = np.arange(len(segments))
    s, p = np.concatenate([k, s, k]), np.concatenate([segments[:, 0], p, segments[:, 1]])
    a, d = points[segments[s, 0]], points[segments[s, 1]] - points[segments[s, 0]]
    along = np.einsum("ij,ij->i", points[p] - a, d)
    order = np.lexsort((p, along, s))
    s, p = s[order], p[order]
    parts = np.flatnonzero((s[1:] == s[:-1]) & (p[1:] != p[:-1]))
    return np.stack([p[parts], p[parts + 1]], 1), s[parts]
