"""Labels of vertices that hang together: stray bits go to the cells around them."""

import numpy as np

from meshjig.mesh.measure import sums
from meshjig.mesh.types import Floats, Ints

__all__ = ["whole"]

_ROUNDS = 8


def whole(E: Ints, owner: Ints, area: Floats) -> Ints:
    """Keep the largest connected part of every label; the rest takes the labels beside it.

    Parameters
    ----------
    E : (e, 2) int64, edges
    owner : (n,) int64, labels 0..N-1
    area : (n,) float64, of each vertex

    Returns
    -------
    (n,) int64
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    n = len(owner)
    owner = owner.copy()
    for _ in range(_ROUNDS):
        a, b = E[owner[E[:, 0]] == owner[E[:, 1]]].T
        graph = coo_matrix((np.ones(len(a), np.int8), (a, b)), shape=(n, n))
        k, part = connected_components(graph, directed=False)
        size, label = sums(part, area, k), np.empty(k, np.int64)
        label[part] = owner
        largest = np.empty(int(owner.max()) + 1, np.int64)
        by_size = np.argsort(size, kind="stable")
        largest[label[by_size]] = by_size
        stray = largest[owner] != part
        if not stray.any():
            break
        ends = np.concatenate([E, E[:, ::-1]])
        beside = ends[stray[ends[:, 0]] & ~stray[ends[:, 1]]]
        if not len(beside):
            break
        owner[beside[:, 0]] = owner[beside[:, 1]]
    return owner
