"""Which faces are connected, at edges and around vertices."""

import numpy as np

from meshjig.mesh.arrays import Bools, Ints, connected
from meshjig.mesh.halfedges import compact, edges, next_halfedge

__all__ = ["components", "fans", "is_disc", "label_components"]


def components(F: Ints, wall: Bools | None = None, twin: Ints | None = None) -> tuple[int, Ints]:
    """Label faces that shared edges connect.

    Parameters
    ----------
    F : (m, 3) int64
    wall : (3 m,) bool, half-edges that don't connect
    twin : (3 m,) int64, of the half-edges, where the caller has them

    Returns
    -------
    n : int
    component_of_face : (m,) int64
    """
    twin = edges(F).twin if twin is None else twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    if wall is not None:
        h = h[~(wall[h] | wall[twin[h]])]
    return connected(len(F), h // 3, twin[h] // 3)


def fans(F: Ints, twin: Ints | None = None) -> tuple[Ints, Ints]:
    """Split every vertex at which faces meet in more than one fan.

    Parameters
    ----------
    F : (m, 3) int64
    twin : (3 m,) int64, of the half-edges, where the caller has them

    Returns
    -------
    F : (m, 3) int64, into the split vertices
    origin : (n,) int64, the old vertex of every new one
    """
    twin = edges(F).twin if twin is None else twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    t = twin[h]
    same = F.ravel()[h] == F.ravel()[t]  # inconsistent orientation: both run the same way
    rows = np.concatenate([h, next_halfedge(h)])
    cols = np.concatenate([np.where(same, t, next_halfedge(t)), np.where(same, next_halfedge(t), t)])
    n, fan = connected(3 * len(F), rows, cols)
    origin = np.empty(n, np.int64)
    origin[fan] = F.ravel()
    return fan.reshape(-1, 3), origin


def is_disc(F: Ints) -> bool:
    """Tell whether faces form one disc: connected, Euler number 1, one simple border loop."""
    if not len(F):
        return False
    G, kept = compact(F)
    e = edges(G)
    if e.n_faces.max() > 2 or len(kept) - len(e.E) + len(G) != 1:
        return False
    border = e.E[e.n_faces == 1]
    if np.bincount(border.ravel(), minlength=len(kept)).max(initial=0) > 2:
        return False
    return components(G)[0] == 1


def label_components(label: Ints, beside: Ints) -> tuple[int, Ints]:
    """Number the connected parts of every label.

    Parameters
    ----------
    label : (m,) int64
    beside : (m, 3) int64, the neighbours of each face, who have it as a neighbour in turn; -1 for none

    Returns
    -------
    n : int
    part : (m,), 0 to n - 1
    """
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import connected_components

    joined = (beside >= 0) & (label[beside] == label[:, None])
    start = np.append(0, np.cumsum(joined @ np.ones(3, np.int8)))
    graph = csr_matrix((np.ones(start[-1]), beside[joined], start), shape=(len(label),) * 2)
    n, part = connected_components(graph, connection="strong")  # without turning the matrix
    return int(n), part
