"""Merge neighbouring patches for as long as the result is a good chart."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.accept import Judge
from meshjig.charts.segment.dual_graph import Dual

__all__ = ["merge"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_CREASE_WORTH = 0.15  # a border along a sharp fold is hardly seen: little is won by removing it
_SIZE, _RIM = 0.5, 0.15  # what a large chart, and one with a long rim for its size, counts against a merge


def merge(dual: Dual, label: Ints, judge: Judge) -> Ints:
    """Merge greedily, the pair first that loses most border for what is left, in size and in rim.

    Parameters
    ----------
    dual : Dual
    label : (m,) int64, 0 to k - 1
    judge : Judge

    Returns
    -------
    label : (m,) int64, 0 to k' - 1
    """
    label = label.copy()
    refused: set[tuple[int, int]] = set()
    while True:
        for a, b in _pairs(dual, label):
            if (a, b) in refused:
                continue
            faces = np.flatnonzero((label == a) | (label == b))
            if judge.accepts(faces):
                label[faces] = a
                refused = {p for p in refused if a not in p and b not in p}
                break
            refused.add((a, b))
        else:
            return np.unique(label, return_inverse=True)[1].astype(np.int64)


def _pairs(dual: Dual, label: Ints) -> list[tuple[int, int]]:
    """List neighbours, the most promising first."""
    k = int(label.max()) + 1
    a, b = label[dual.first], label[dual.second]
    seam = np.flatnonzero(a != b)
    a, b = np.minimum(a, b)[seam], np.maximum(a, b)[seam]
    worth = dual.length[seam] * (_CREASE_WORTH + (1 - _CREASE_WORTH) * np.clip(dual.bend[seam], 0, 1))
    pair, which = np.unique(a * k + b, return_inverse=True)
    shared = np.bincount(which, worth, len(pair))
    a, b = pair // k, pair % k
    border = np.bincount(a, shared, k) + np.bincount(b, shared, k)
    area = np.bincount(label, dual.area, k)
    gain = shared / np.maximum(np.minimum(border[a], border[b]), 1e-300)
    size = np.sqrt(area[a] + area[b])
    rim = (border[a] + border[b] - 2 * shared) / np.maximum(size, 1e-300)
    cost = _SIZE * size / np.sqrt(area.sum()) + _RIM * rim - gain
    order = np.argsort(cost, kind="stable")
    return list(zip(a[order].tolist(), b[order].tolist(), strict=True))
