"""Faces cut along a level line of a function on the vertices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.halfedges import edges
from meshjig.mesh.types import Floats, Ints

__all__ = ["LevelSplit", "split_at_zero"]

_SNAP = 0.12  # of an edge: a line that passes a vertex as near as that is led through it


class LevelSplit(NamedTuple):
    """A mesh of which no face has a function's line inside it."""

    V: Floats  # (n, 3), the given vertices first
    F: Ints  # (m, 3)
    parent: Ints  # (m,), the face that each is a part of
    sign: Ints  # (m,), 1 or -1, of the function on each face; 0 where it is 0 at all corners


def split_at_zero(V: Floats, F: Ints, values: Floats) -> LevelSplit:
    """Cut faces along the line where a function that is linear on each of them is zero.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    values : (n,) float64

    Returns
    -------
    LevelSplit
        The surface stays the same. Where the line passes close to a vertex it is led through it.
    """
    e = edges(F)
    a, b = e.E.T
    side = np.sign(values).astype(np.int64)
    across = np.flatnonzero(side[a] * side[b] < 0)
    t = values[a[across]] / (values[a[across]] - values[b[across]])
    side[a[across[t < _SNAP]]] = 0
    side[b[across[t > 1 - _SNAP]]] = 0
    cut = np.flatnonzero(side[a] * side[b] < 0)
    t = (values[a[cut]] / (values[a[cut]] - values[b[cut]]))[:, None]
    new = np.full(len(e.E), -1)
    new[cut] = len(V) + np.arange(len(cut))
    V = np.concatenate([V, (1 - t) * V[a[cut]] + t * V[b[cut]]])
    F, parent = _divided(F, new[e.edge_of_halfedge].reshape(-1, 3))
    side = np.concatenate([side, np.zeros(len(cut), np.int64)])
    return LevelSplit(V, F, parent, np.sign(side[F].sum(axis=1)))


def _divided(F: Ints, new: Ints) -> tuple[Ints, Ints]:
    """Divide faces, (m, 3), with a new vertex on none, one or two of their edges, (m, 3), -1 for none."""
    count = (new >= 0).sum(axis=1)
    whole = np.flatnonzero(count == 0)
    one, two = np.flatnonzero(count == 1), np.flatnonzero(count == 2)
    (a, b, c), (p, _, _) = _turned(F, new, one, new[one].argmax(axis=1))
    halves = [np.stack([a, p, c], 1), np.stack([p, b, c], 1)]
    (i, j, k), (q, r, _) = _turned(F, new, two, (new[two].argmin(axis=1) + 1) % 3)
    thirds = [np.stack([i, q, k], 1), np.stack([q, j, r], 1), np.stack([q, r, k], 1)]
    return np.concatenate([F[whole], *halves, *thirds]), np.concatenate([whole, one, one, two, two, two])


def _turned(F: Ints, new: Ints, rows: Ints, first: Ints) -> tuple[Ints, Ints]:
    """Give corners of some faces from one on, and what is new on the edges after them; two (3, k)."""
    order = (first + np.arange(3)[:, None]) % 3
    return F[rows, order], new[rows, order]
