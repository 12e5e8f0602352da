"""Draw apart the stretches of a chart's border that run into each other in the plane."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.border import border_loop
from meshjig.charts.untangle import untangle
from meshjig.topology import edges

__all__ = ["part"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def part(V: Floats, F: Ints, uv: Floats, rounds: int = 12) -> Floats:
    """Pull crossing borders inward, each into its own side, until they cross no more.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm, without mirrored faces
    rounds : int

    Returns
    -------
    uv : (n, 2) float64, mm. Borders may still cross, or faces be mirrored: the caller checks.
    """
    from scipy.sparse import coo_matrix, diags

    loop = border_loop(F)
    crossing = _crossing(uv[loop])
    if not len(crossing):
        return uv
    E, n = edges(F).E, len(V)
    W = coo_matrix((np.ones(len(E)), E.T), shape=(n, n))
    W = (W + W.T).tocsr()
    mean = diags(1 / np.asarray(W.sum(1)).ravel()) @ W
    for width in range(1, rounds + 1):
        near = (crossing[:, None] + np.arange(-width, width + 2)).ravel() % len(loop)
        pulled = np.unique(loop[near])
        uv = uv.copy()
        uv[pulled] = (uv[pulled] + mean[pulled] @ uv) / 2
        uv = untangle(V, F, uv)
        crossing = _crossing(uv[loop])
        if not len(crossing):
            break
    return uv


def _crossing(ring: Floats) -> Ints:
    """List the segments of a ring that meet others than their neighbours."""
    import shapely

    segments = shapely.linestrings(np.stack([ring, np.roll(ring, -1, 0)], 1))
    a, b = shapely.STRtree(segments).query(segments, predicate="intersects")
    apart = np.abs(a - b)
    return np.unique(a[(apart > 1) & (apart < len(ring) - 1)])
