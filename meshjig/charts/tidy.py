"""Clean labels that were copied onto a mesh: no islands, no teeth, no pinched vertices."""

import numpy as np
from numpy.typing import NDArray

from meshjig.topology import components, edges

__all__ = ["tidy"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_ROUNDS = 60


def tidy(F: Ints, label: Ints, area: Floats) -> Ints:
    """Let every label be one region with a plain border, as far as small changes can do it.

    Parameters
    ----------
    F : (m, 3) int64, manifold, one component
    label : (m,) int64; -1 where it is unknown
    area : (m,) float64, weighs the parts of a label against each other

    Returns
    -------
    label : (m,) int64, no -1 left where any label was given
    """
    twin = edges(F).twin
    around = np.where(twin == np.arange(len(twin)), -1, twin // 3).reshape(-1, 3)
    label = _without_islands(F, label.copy(), area, around)
    for n in range(_ROUNDS):
        change = _majority(label, around)
        turn = (change >= 0) & (change != label)
        if turn.any():
            # All at once, neighbouring teeth would swap for ever.
            turn &= np.random.default_rng(n).random(len(label)) < 0.6
            label[turn] = change[turn]
            continue
        pinched = _pinched(F, label, twin)
        if not len(pinched):
            break
        _unpinch(F, label, pinched)
        label = _without_islands(F, label, area, around)
    return _without_islands(F, label, area, around)


def _without_islands(F: Ints, label: Ints, area: Floats, around: Ints) -> Ints:
    """Give all but the largest part of each label to the labels around."""
    twin = edges(F).twin
    wall = np.repeat(label, 3) != np.repeat(label, 3)[twin]
    n, part = components(F, wall)
    size = np.bincount(part, area, n)
    owner = np.empty(n, np.int64)
    owner[part] = label
    order = np.argsort(size, kind="stable")
    largest = np.full(int(label.max()) + 1, -1)
    known = order[owner[order] >= 0]
    largest[owner[known]] = known
    loose = (owner[part] < 0) | (largest[owner[part]] != part)
    while loose.any():
        near = np.where((around >= 0) & ~loose[around], label[around], -1)
        best = np.where(near[:, 1] == near[:, 2], near[:, 1], near[:, 0])
        best = np.where(best < 0, near.max(1), best)
        reached = loose & (best >= 0)
        if not reached.any():
            break
        label[reached] = best[reached]
        loose[reached] = False
    return label


def _majority(label: Ints, around: Ints) -> Ints:
    """Give the label that two neighbours of a face share, or -1."""
    a, b, c = np.where(around >= 0, label[around], -1).T
    return np.where((a == b) | (a == c), a, np.where(b == c, b, -1))


def _pinched(F: Ints, label: Ints, twin: Ints) -> Ints:
    """List vertices at which one label has more than one sector."""
    k = int(label.max()) + 1
    h = np.arange(len(twin))
    rim = np.flatnonzero((twin == h) | (label[h // 3] != label[twin // 3]))
    key = F.ravel()[rim] * k + label[rim // 3]  # a sector has one half-edge of its rim leaving the vertex
    unique, count = np.unique(key, return_counts=True)
    return np.unique(unique[count > 1] // k)


def _unpinch(F: Ints, label: Ints, pinched: Ints) -> None:
    """Give all faces around a pinched vertex the label that most of them have."""
    n, k = int(F.max()) + 1, int(label.max()) + 1
    chosen = np.full(n, -1)
    touches = np.isin(F, pinched)
    face = np.repeat(np.flatnonzero(touches.any(1)), 3)
    corner = F[touches.any(1)].ravel()
    keep = np.isin(corner, pinched)
    key, count = np.unique(corner[keep] * k + label[face[keep]], return_counts=True)
    order = np.argsort(count, kind="stable")
    chosen[key[order] // k] = key[order] % k
    for j in range(3):
        hit = chosen[F[:, j]] >= 0
        label[hit] = chosen[F[hit, j]]
