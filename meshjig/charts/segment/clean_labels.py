"""Clean labels that were copied onto a mesh: no islands, no teeth, no pinched vertices."""

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.halfedges import edges

__all__ = ["tidy"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_ROUNDS = 60


def tidy(F: Ints, label: Ints, area: Floats, twin: Ints | None = None) -> Ints:
    """Let every label be one region with a plain border, as far as small changes can do it.

    Parameters
    ----------
    F : (m, 3) int64, manifold, one component
    label : (m,) int64; -1 where it is unknown
    area : (m,) float64, weighs the parts of a label against each other
    twin : (3 m,) int64, of the half-edges, where the caller has them

    Returns
    -------
    label : (m,) int64, no -1 left where any label was given
    """
    twin = edges(F).twin if twin is None else twin
    around = np.where(twin == np.arange(len(twin)), -1, twin // 3).reshape(-1, 3)
    label = _without_islands(label.copy(), area, around)
    for n in range(_ROUNDS):
        _without_teeth(label, around, n)
        pinched = _pinched(F, label, twin)
        if not len(pinched):
            break
        _unpinch(F, label, pinched)
        label = _without_islands(label, area, around)
    return _without_islands(label, area, around)


def _without_islands(label: Ints, area: Floats, around: Ints) -> Ints:
    """Give all but the largest part of each label to the labels around."""
    n, part = _parts(label, around)
    size = np.bincount(part, area, n)
    owner = np.empty(n, np.int64)
    owner[part] = label
    order = np.argsort(size, kind="stable")
    largest = np.full(int(label.max()) + 1, -1)
    known = order[owner[order] >= 0]
    largest[owner[known]] = known
    stray = (owner < 0) | (largest[owner] != np.arange(n))
    loose = stray[part]
    todo = np.flatnonzero(loose)
    while len(todo):
        near = np.where((around[todo] >= 0) & ~loose[around[todo]], label[around[todo]], -1)
        best = np.where(near[:, 1] == near[:, 2], near[:, 1], near[:, 0])
        best = np.where(best < 0, near.max(1), best)
        reached = best >= 0
        if not reached.any():
            break
        label[todo[reached]] = best[reached]
        loose[todo[reached]] = False
        todo = todo[~reached]
    return label


def _parts(label: Ints, around: Ints) -> tuple[int, Ints]:
    """Number the regions of one label that hang together."""
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import connected_components

    joined = (around >= 0) & (label[around] == label[:, None])
    start = np.append(0, np.cumsum(joined @ np.ones(3, np.int8)))
    graph = csr_matrix((np.ones(start[-1]), around[joined], start), shape=(len(label),) * 2)
    n, part = connected_components(graph, connection="strong")  # without turning the matrix
    return int(n), part


def _without_teeth(label: Ints, around: Ints, seed: int) -> None:
    """Give faces between two neighbours of one other label that label, until none is left."""
    near = np.where(around >= 0, label[around], -1)
    active = np.flatnonzero((near != label[:, None]).any(1))
    for n in range(_ROUNDS):
        change = _majority(label, around[active])
        turn = (change >= 0) & (change != label[active])
        if not turn.any():
            return
        # All at once, neighbouring teeth would swap for ever.
        turn &= np.random.default_rng([seed, n]).random(len(active)) < 0.6
        turned = active[turn]
        label[turned] = change[turn]
        active = np.unique(np.concatenate([active, around[turned].ravel()]))
        active = active[active >= 0]


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
