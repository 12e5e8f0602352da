"""Which cells are discs, which are rings."""

import numpy as np

from meshjig.topology import Edges
from meshjig.types import Ints

__all__ = ["DISC", "RING", "shapes"]

DISC, RING, OTHER = 1, 0, -99


def shapes(F: Ints, cell: Ints, n: int, e: Edges) -> Ints:
    """Tell what shape cells have.

    Parameters
    ----------
    F : (m, 3) int64, manifold
    cell : (m,) int64, 0 to n - 1
    n : int
    e : Edges, of F

    Returns
    -------
    (n,) int64, the Euler number: 1 for a disc, 0 for a ring; -99 for a cell that is empty, in parts, or
    touches itself at a vertex
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    twin = e.twin
    h = np.arange(len(twin))
    other = twin // 3
    inner = (twin != h) & (cell[h // 3] == cell[other])
    a, b = h[inner & (twin > h)] // 3, other[inner & (twin > h)]
    graph = coo_matrix((np.ones(len(a), np.int8), (a, b)), shape=(len(F), len(F)))
    k, part = connected_components(graph, directed=False)
    of_part = np.empty(k, np.int64)
    of_part[part] = cell
    corners = np.unique(F.ravel() * np.int64(n) + np.repeat(cell, 3)) % n
    n_edges = np.bincount(cell[h[~inner] // 3], minlength=n) + np.bincount(cell[a], minlength=n)
    euler = np.bincount(corners, minlength=n) - n_edges + np.bincount(cell, minlength=n)
    start = F.ravel()[~inner] * np.int64(n) + cell[h[~inner] // 3]
    found, count = np.unique(start, return_counts=True)
    pinched = np.bincount(found[count > 1] % n, minlength=n) > 0
    sound = (np.bincount(of_part, minlength=n) == 1) & ~pinched
    return np.where(sound, euler, OTHER)
