"""Put vertices that landed far off in the plane back among their neighbours."""

import numpy as np

from meshjig.measure import edge_lengths
from meshjig.topology import edges
from meshjig.types import Floats, Ints

__all__ = ["without_strays"]

_LONGEST = 3.0  # an edge in the plane over the edge in space


def without_strays(V: Floats, F: Ints, uv: Floats) -> Floats:
    """Place strays at the mean of their neighbours.

    Where two sheets of a surface come close, a vertex may be taken for one of the other sheet. Edges
    that become much too long give it away: vertices stray that hang on the rest by such edges only.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm

    Returns
    -------
    uv : (n, 2) float64, mm; itself where nothing strays
    """
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.csgraph import connected_components
    from scipy.sparse.linalg import spsolve

    n = len(V)
    sides = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    is_sound = edge_lengths(uv, sides) <= _LONGEST * edge_lengths(V, sides)
    if is_sound.all():
        return uv
    sound = sides[is_sound]
    graph = coo_matrix((np.ones(len(sound)), sound.T), shape=(n, n))
    _, part = connected_components(graph, directed=False)
    stray = part != np.bincount(part).argmax()
    if not stray.any():
        return uv
    E = edges(F).E
    W = coo_matrix((np.ones(len(E)), E.T), shape=(n, n)).tocsr()
    W = W + W.T
    L = (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()[stray]
    placed = uv.copy()
    placed[stray] = spsolve(L[:, stray].tocsc(), -(L[:, ~stray] @ uv[~stray])).reshape(-1, 2)
    return placed
