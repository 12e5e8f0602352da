"""Plain arrays that can be trusted by native code."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints

__all__ = ["validated", "weld"]


def validated(V: Any, F: Any, name: str = "a piece") -> tuple[Floats, Ints]:
    """Give a piece as float64 and int64 arrays, or say why it is none.

    Native code reads such arrays without looking: a stray index is a crash, and a coordinate that
    is no number makes every predicate meaningless.

    Parameters
    ----------
    V : (n, 3) array, mm
    F : (m, 3) array of integers
    name : str, what the error calls the piece

    Returns
    -------
    V : (n, 3) float64, contiguous
    F : (m, 3) int64, contiguous

    Raises
    ------
    InputError
        Wrong shapes, no faces, coordinates that are not finite, indices out of range.
    """
    V, F = np.ascontiguousarray(V, np.float64), np.ascontiguousarray(F, np.int64)
    if V.ndim != 2 or V.shape[1:] != (3,) or F.ndim != 2 or F.shape[1:] != (3,):
        raise InputError(
            f"{name}: vertices of shape {V.shape} and faces of shape {F.shape} are no triangle mesh"
        )
    if not len(F):
        raise InputError(f"{name}: no faces")
    if F.min() < 0 or F.max() >= len(V):
        raise InputError(f"{name}: faces name vertices that do not exist")
    if not np.isfinite(V).all():
        raise InputError(f"{name}: some coordinates are not finite numbers")
    return V, F


def weld(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """Merge vertices whose coordinates are equal, and drop faces that have lost a corner by it.

    This is what every reader of an STL does, and nothing looser: no tolerance.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64

    Returns
    -------
    V : (k, 3) float64, in their old order
    F : (l, 3) int64
    """
    V = V + 0.0  # -0.0 becomes 0.0
    first, group = _first_of_equal_rows(V)
    G = group[F]
    whole = (G[:, 0] != G[:, 1]) & (G[:, 1] != G[:, 2]) & (G[:, 2] != G[:, 0])
    return V[first], G[whole]


def _first_of_equal_rows(X: Floats) -> tuple[Ints, Ints]:
    """Give the first row of every set of equal rows, and for every row the number of its set."""
    key = _row_hash(X)
    order = np.argsort(key, kind="stable")
    new = np.ones(len(X), bool)
    new[1:] = key[order][1:] != key[order][:-1]
    number = np.cumsum(new) - 1
    head = order[new]
    if not (X[order] == X[head[number]]).all():  # two different rows with one hash: take the slow road
        _, head, inverse = np.unique(X, axis=0, return_index=True, return_inverse=True)
        group = inverse.ravel()
    else:
        group = np.empty(len(X), np.int64)
        group[order] = number
    by_first = np.argsort(head)
    rank = np.empty(len(head), np.int64)
    rank[by_first] = np.arange(len(head))
    return head[by_first], rank[group]


def _row_hash(X: Floats) -> Any:
    """Mix the bits of three coordinates into one 64-bit number a row."""
    bits = np.ascontiguousarray(X).view(np.uint64)
    key = bits[:, 0] * np.uint64(0x9E3779B97F4A7C15)
    for axis in (1, 2):
        key = (key ^ (key >> np.uint64(29))) * np.uint64(0xBF58476D1CE4E5B9) + bits[:, axis]
    return key * np.uint64(0x94D049BB133111EB)
