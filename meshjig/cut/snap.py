"""Bring a chart plane and its outlines onto one integer grid."""

from collections import Counter
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from meshjig.errors import CutError
from meshjig.types import Bools, Floats, Ints, Outlines

__all__ = ["FINEST", "Graph", "snap"]

FINEST = 18  # the grid is never finer than 2^-18 mm
LIMIT = 2**30  # orient() is exact below
SHORT_MM = 0.0  # shorter segments are contracted: nothing printable is that small


class Graph(NamedTuple):
    """Outlines on the grid: no two points alike, no two segments alike, none without length."""

    points: Ints  # (n, 2)
    segments: Ints  # (k, 2)
    left: Ints  # (k,)
    right: Ints  # (k,)
    source: Ints  # (k,), the number of the segment in the outlines
    point: Ints  # (p,), where the points of the outlines went


def snap(uv: Floats, outlines: Outlines) -> tuple[Ints, Graph]:
    """Round UV and outlines to a grid of 2^-18 mm, or coarser for more than a metre.

    Parameters
    ----------
    uv : (n, 2) float64, mm
    outlines : Outlines

    Returns
    -------
    U : (n, 2) int64
    graph : Graph

    Raises
    ------
    CutError
        A coordinate is not finite.
    """
    everything = np.concatenate([uv, outlines.points])
    if not np.isfinite(everything).all():
        raise CutError("a chart or an outline has coordinates that are no numbers", hint="flatten it anew")
    low = everything.min(axis=0, initial=np.inf)
    extent = float((everything.max(axis=0, initial=-np.inf) - low).max())
    exponent = FINEST if extent <= 0 else min(FINEST, int(np.floor(np.log2((LIMIT - 2) / extent))))
    scale = 2.0**exponent
    # the origin is a whole grid step, so that equal grids give equal rounding wherever the chart lies
    origin = np.floor(low * scale)
    U = (np.rint(uv * scale) - origin).astype(np.int64)
    P = (np.rint(outlines.points * scale) - origin).astype(np.int64)
    return U, _contracted(P, outlines, SHORT_MM * scale)


def _contracted(P: Ints, outlines: Outlines, short: float) -> Graph:
    """Merge points that coincide or hang on a short segment, and the segments between them."""
    ends = outlines.segments
    key = (P[:, 0] << 31) | P[:, 1]
    _, first, number = np.unique(key, return_index=True, return_inverse=True)
    place = P[first]
    span = np.abs(P[ends[:, 0]] - P[ends[:, 1]]).max(axis=1, initial=0)
    tiny = ends[(span > 0) & (span < short)]
    if len(tiny):
        rows, cols = number[tiny[:, 0]], number[tiny[:, 1]]
        joined = coo_matrix((np.ones(len(tiny), np.int8), (rows, cols)), shape=(len(place), len(place)))
        _, merged = connected_components(joined, directed=False)
        _, first = np.unique(merged, return_index=True)
        number, place = merged[number], place[first]
    number = number.astype(np.int64)
    S = number[ends]
    keep = np.flatnonzero(S[:, 0] != S[:, 1])
    left, right = outlines.left[keep], outlines.right[keep]
    S, source, left, right = _single(S[keep], keep, left, right, len(place))
    thin = _spurs(S, np.bincount(ends.ravel(), minlength=len(P)), number, len(place))
    return Graph(place, S[~thin], left[~thin], right[~thin], source[~thin], number)


def _single(S: Ints, source: Ints, left: Ints, right: Ints, n: int) -> tuple[Ints, Ints, Ints, Ints]:
    """Replace segments that came to lie on each other by one with the outermost labels, or by none."""
    turned = S[:, 0] > S[:, 1]
    key = S.min(axis=1, initial=n) * np.int64(n) + S.max(axis=1, initial=-1)
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    begins = np.flatnonzero(np.append(True, ordered[1:] != ordered[:-1])) if len(key) else order
    counts = np.diff(np.append(begins, len(key)))
    if (counts <= 1).all():
        return S, source, left, right
    L, R = np.where(turned, right, left), np.where(turned, left, right)
    keep = np.ones(len(S), bool)
    left, right = left.copy(), right.copy()
    for b, c in zip(begins[counts > 1], counts[counts > 1], strict=True):
        group = order[b : b + c]
        keep[group[1:]] = False
        ls, rs = Counter(L[group].tolist()), Counter(R[group].tolist())
        outer_left, outer_right = ls - rs, rs - ls
        if not outer_left or not outer_right:
            keep[group[0]] = False
            continue
        one, other = next(iter(outer_left)), next(iter(outer_right))
        g = group[0]
        left[g], right[g] = (other, one) if turned[g] else (one, other)
    return S[keep], source[keep], left[keep], right[keep]


def _spurs(S: Ints, degree_before: Ints, number: Ints, n: int) -> Bools:
    """Mark segments that contraction has left dangling; (k,) bool."""
    closed = np.ones(n, bool)
    closed[number[degree_before == 1]] = False
    thin = np.zeros(len(S), bool)
    while True:
        degree = np.bincount(S[~thin].ravel(), minlength=n)
        loose = ((degree == 1) & closed)[S].any(axis=1) & ~thin
        if not loose.any():
            return thin
        thin |= loose
