"""Fewer points on a line, within a tolerance."""

from __future__ import annotations

import numpy as np

from meshjig.types import Bools, Floats, Ints

__all__ = ["simplified"]


def simplified(points: list[Floats], start: Ints, tolerance: float) -> Bools:
    """Choose the points that several parallel copies of some lines can't do without (Douglas-Peucker).

    Parameters
    ----------
    points : list of (n, 3) float64, mm
        The copies. A point stays when any copy needs it.
    start : (c + 1,) int64
        Where each line starts; the last entry is n. A line has two points at least.
    tolerance : float, mm

    Returns
    -------
    (n,) bool; both ends of every line stay, and a third point of those that end where they start

    Notes
    -----
    All lines are split at once, so the cost is a few passes over the points.

    References
    ----------
    Douglas and Peucker, "Algorithms for the reduction of the number of points required to represent a
    digitized line or its caricature", 1973.
    """
    keep = np.zeros(int(start[-1]), bool)
    low, high = start[:-1], start[1:] - 1
    keep[low] = keep[high] = True
    while len(low):
        count = high - low - 1
        low, high, count = low[count > 0], high[count > 0], count[count > 0]
        if not len(low):
            break
        at = np.cumsum(count) - count
        inner = np.arange(count.sum()) - np.repeat(at - low - 1, count)
        i, j = np.repeat(low, count), np.repeat(high, count)
        off = np.max([_distances(P[inner], P[i], P[j]) for P in points], axis=0)
        worst = np.maximum.reduceat(off, at)
        is_worst = np.flatnonzero(off == np.repeat(worst, count))
        where = is_worst[np.searchsorted(is_worst, at)]
        split = worst > tolerance
        middle = inner[where[split]]
        keep[middle] = True
        low, high = np.concatenate([low[split], middle]), np.concatenate([middle, high[split]])
    return keep


def _distances(P: Floats, A: Floats, B: Floats) -> Floats:
    """Give the distances of points to the segments from A to B, (n,), mm."""
    d, w = B - A, P - A
    along = np.einsum("ij,ij->i", w, d) / np.maximum(np.einsum("ij,ij->i", d, d), 1e-300)
    return np.linalg.norm(w - np.clip(along, 0, 1)[:, None] * d, axis=1)
