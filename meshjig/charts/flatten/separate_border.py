"""Draw apart the stretches of a chart's border that run into each other in the plane."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.flatten.untangle import faces_around, untangle
from meshjig.mesh.boundary_loops import border_loop
from meshjig.mesh.halfedges import compact, edges

__all__ = ["part"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


_RINGS = 20  # of faces around crossing borders that may be moved


def part(V: Floats, F: Ints, uv: Floats, rounds: int = 12, border: Ints | None = None) -> Floats:
    """Pull crossing borders inward, each into its own side, until they cross no more.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm, without mirrored faces
    rounds : int
    border : (b,) int64, its border loop, where the caller has it

    Returns
    -------
    uv : (n, 2) float64, mm. Borders may still cross, or faces be mirrored: the caller checks.
    """
    loop = border_loop(F) if border is None else border
    crossing = _crossing(uv[loop])
    for width in range(1, rounds + 1):
        if not len(crossing):
            break
        near = (crossing[:, None] + np.arange(-width, width + 2)).ravel() % len(loop)
        uv = _pulled(V, F, uv, np.unique(loop[near]))
        crossing = _crossing(uv[loop])
    return uv


def _pulled(V: Floats, F: Ints, uv: Floats, pulled: Ints) -> Floats:
    """Move vertices half-way to the mean of their neighbours, and turn back what that mirrors near them."""
    from scipy.sparse import coo_matrix

    chosen = np.zeros(len(V), bool)
    chosen[pulled] = True
    touching = np.any(chosen[F], axis=1)
    H, kept = compact(F[faces_around(F, touching, _RINGS)])
    own, E = np.flatnonzero(chosen[kept]), edges(H).E
    W = coo_matrix((np.ones(len(E)), E.T), shape=(len(kept),) * 2).tocsr()
    W = (W + W.T)[own]
    local = uv[kept]
    local[own] = (local[own] + (W @ local) / np.asarray(W.sum(1)).reshape(-1, 1)) / 2
    uv = uv.copy()
    uv[kept] = untangle(V[kept], H, local)
    return uv


def _crossing(ring: Floats) -> Ints:
    """List the segments of a ring that meet others than their neighbours."""
    import shapely

    segments = shapely.linestrings(np.stack([ring, np.roll(ring, -1, 0)], 1))
    a, b = shapely.STRtree(segments).query(segments, predicate="intersects")
    apart = np.abs(a - b)
    return np.unique(a[(apart > 1) & (apart < len(ring) - 1)])
