"""Charts without thin parts: what is thinner gets lost on the way to another mesh, and holds no tile."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.clean_labels import tidy
from meshjig.charts.segment.region import Region
from meshjig.mesh.halfedges import edges

__all__ = ["is_stout", "stouter"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_SMALL = 30  # faces; smaller regions are not asked for more than to be discs
_TIPS = 4  # thin faces that may always be, or as a share of all:
_TIPS_SHARE = 0.02


def is_stout(region: Region) -> bool:
    """Tell whether a region has neither thin necks nor long thin tips.

    Every two inner vertices must hang together over edges between inner vertices, and only a few
    faces may be away from all faces that have one.
    """
    F, n = region.F, len(region.kept)
    if len(F) < _SMALL:
        return True
    inner = np.ones(n, bool)
    inner[region.loop] = False
    core = inner[F].any(1)
    at_core = np.zeros(n, bool)
    at_core[F[core].ravel()] = True
    if (~at_core[F].any(1)).sum() > max(_TIPS, _TIPS_SHARE * len(F)):
        return False
    # All that is not inner hangs together along the rim, so that what is inner has no holes: its Euler
    # number is the number of its parts.
    following = inner[np.roll(F, -1, 1)]
    n_edges = int((inner[F] & following).sum()) // 2
    return int(inner.sum()) - n_edges + int(inner[F].all(1).sum()) <= 1


def stouter(F: Ints, label: Ints, area: Floats) -> Ints:
    """Cut labels at their thin necks, and give their thin tips to the labels around.

    Parameters
    ----------
    F : (m, 3) int64, manifold, one component
    label : (m,) int64, 0 to k - 1
    area : (m,) float64, mm2

    Returns
    -------
    label : (m,) int64, 0 to k' - 1
    """
    n = int(F.max()) + 1
    low, high = np.full(n, len(label)), np.full(n, -1)
    np.minimum.at(low, F.ravel(), np.repeat(label, 3))
    np.maximum.at(high, F.ravel(), np.repeat(label, 3))
    inner = low == high
    part = _hung_together(edges(F).E, inner)
    out = np.where(inner[F], part[F], -1).max(1)
    if (out < 0).all():
        return label
    out[out >= 0] = np.unique(out[out >= 0], return_inverse=True)[1]
    return np.unique(tidy(F, out, area), return_inverse=True)[1].astype(np.int64)


def _hung_together(ends: Ints, inner: Bools) -> Ints:
    """Number the groups of inner vertices that edges join, (n,)."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    ends = ends[inner[ends].all(1)]
    graph = coo_matrix((np.ones(len(ends), np.int8), ends.T), shape=(len(inner),) * 2)
    return connected_components(graph, directed=False)[1].astype(np.int64)
