"""Fewer points on the lines that walls stand on, within a tolerance."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, ragged, starts
from meshjig.solid.wall_edges import bent

__all__ = ["simplified"]


def simplified(X: Floats, Y: Floats, start: Ints, tolerance: float, bend: float) -> Bools:
    """Choose the points of some lines that walls ruled from X to Y can't do without.

    Parameters
    ----------
    X, Y : (n, 3) float64, mm, the walls' top and bottom
    start : (c + 1,) int64
        Where each line starts; the last entry is n. A line has two points at least.
    tolerance : float, mm
        How far the two lines of a wall may move.
    bend : float, mm
        How far a twisted quad's diagonal may be from the ruled wall.

    Returns
    -------
    (n,) bool; both ends of every line stay, and a third point of those that end where they start

    Notes
    -----
    The rule of Douglas and Peucker for both lines at once. All lines are split together, so the cost is a few
    passes over the points.

    References
    ----------
    Douglas and Peucker, "Algorithms for the reduction of the number of points required to represent a
    digitized line or its caricature", 1973.
    """
    keep = np.zeros(int(start[-1]), bool)
    low, high = start[:-1], start[1:] - 1
    keep[low] = keep[high] = True
    while True:
        open_ = high - low > 1
        low, high = low[open_], high[open_]
        if not len(low):
            return keep
        count = high - low - 1
        at, inner = starts(count), ragged(low + 1, count)
        i, j = np.repeat(low, count), np.repeat(high, count)
        off = np.maximum(_distances(X[inner], X[i], X[j]), _distances(Y[inner], Y[i], Y[j]))
        worst = np.maximum.reduceat(off, at)
        is_worst = np.flatnonzero(off == np.repeat(worst, count))
        middle = inner[is_worst[np.searchsorted(is_worst, at)]]
        turns = (worst <= tolerance) & bent(X, Y, low, high, bend)
        middle = np.where(turns, (low + high) // 2, middle)
        split = turns | (worst > tolerance)
        low, middle, high = low[split], middle[split], high[split]
        keep[middle] = True
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])


def _distances(P: Floats, A: Floats, B: Floats) -> Floats:
    """Give the distances of points to the segments from A to B, (n,), mm."""
    d, w = B - A, P - A
    along = np.einsum("ij,ij->i", w, d) / np.maximum(np.einsum("ij,ij->i", d, d), 1e-300)
    return np.asarray(np.linalg.norm(w - np.clip(along, 0, 1)[:, None] * d, axis=1))
