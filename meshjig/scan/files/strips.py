"""Triangle strips as triangles."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Ints, starts

__all__ = ["strip_triangles"]


def strip_triangles(corners: Ints, sizes: Ints) -> Ints:
    """Give the triangles of strips, every other one turned so that all face one side.

    Parameters
    ----------
    corners : (c,) int64, strip after strip; a negative number ends a strip, too
    sizes : (s,) int64

    Returns
    -------
    (t, 3) int64, without those that only lead to where a strip goes on
    """
    place = np.arange(len(corners))
    begins = np.zeros(len(corners), bool)
    begins[starts(sizes)[sizes > 0]] = True
    begins |= corners < 0
    since = place - np.maximum.accumulate(np.where(begins, place + (corners < 0), 0))
    last = np.flatnonzero((since >= 2) & (corners >= 0))
    odd = since[last] % 2
    F = corners[np.stack([last - 2 + odd, last - 1 - odd, last], 1)]
    a, b, c = F.T
    return F[(a != b) & (b != c) & (c != a)]
