"""Which points lie in one place, or nearly so, among millions of which hardly any do."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Bools, Floats, Ints

__all__ = ["are_distinct", "close_pairs"]

_MIX = (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9)  # odd, without a pattern in their bits


def close_pairs(P: Floats, tolerance: float) -> Ints:
    """List enough pairs of points to connect all that lie within a tolerance of each other.

    Parameters
    ----------
    P : (n, 3) float64
    tolerance : float, in the units of P

    Returns
    -------
    (k, 2) int64, in no order
    """
    from scipy.spatial import cKDTree

    P = P + 0.0  # -0 and 0 are one place
    order = np.argsort(_hashes(P))
    ordered = P[order]
    same = (ordered[1:] == ordered[:-1]).all(axis=1)
    exact = np.stack([order[:-1][same], order[1:][same]], 1)
    first = order[np.concatenate([[True], ~same])]  # one of each place: an STL has six in each
    first = first[_in_company(P[first], tolerance)]
    if not len(first):
        return exact
    near = first[cKDTree(P[first]).query_pairs(tolerance, output_type="ndarray")]
    return np.concatenate([exact, near.reshape(-1, 2)])


def are_distinct(P: Floats) -> bool:
    """Tell whether surely no two of some points (n, 3) are one; False may also stand for a rare doubt."""
    hashes = np.sort(_hashes(P + 0.0))
    return bool((hashes[1:] != hashes[:-1]).all())


def _hashes(P: Floats) -> NDArray[np.uint64]:
    """Give a number for each point, equal for equal ones; others share one so rarely that it does no harm."""
    bits = np.ascontiguousarray(P).view(np.uint64)
    mixed = np.zeros(len(P), np.uint64)
    for k, odd in enumerate(_MIX):
        mixed ^= bits[:, k]
        mixed *= np.uint64(odd)
        mixed ^= mixed >> np.uint64(29)
    return mixed


def _in_company(P: Floats, tolerance: float) -> Bools:
    """Tell which points may have another within a tolerance: those that no gap parts from all others.

    Along each axis in turn, points fall into groups between which there are gaps wider than that; who is
    alone in a group is done with.
    """
    left, group = np.arange(len(P)), np.zeros(len(P), np.int64)
    for axis in range(3):
        x = P[left, axis]
        order = np.argsort(x) if axis == 0 else np.lexsort([x, group])
        left, group, x = left[order], group[order], x[order]
        new = np.ones(len(x), bool)
        new[1:] = (np.diff(x) > tolerance) | (group[1:] != group[:-1])
        group = np.cumsum(new) - 1
        together = np.bincount(group)[group] > 1
        left, group = left[together], group[together]
    out = np.zeros(len(P), bool)
    out[left] = True
    return out
