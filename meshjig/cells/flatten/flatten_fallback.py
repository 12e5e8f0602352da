"""Cells that rigid flattening folds: flattened so that no face is ever mirrored."""

import numpy as np

from meshjig.cells.flatten.batched_arap import arap
from meshjig.cells.flatten.batched_tutte import tutte
from meshjig.cells.flatten.planar import Patches, folded, scaled, simple, subset
from meshjig.cells.flatten.untangle_cells import unfolded
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["rescued"]

_RIGID = 60  # rounds from a disc, far from isometry, to near it
_ITERATIONS = (25, 5, 1)  # fewer where the border of a cell would grow into itself


def rescued(p: Patches, chosen: Bools) -> tuple[Ints, Floats]:
    """Flatten some of the cells, near to isometry and without folds.

    All start from a round disc, from which rigid flattening mostly comes out without folds; where it does
    not, a way is taken on which no face can ever be mirrored.

    Parameters
    ----------
    p : Patches, discs
    chosen : (n,) bool

    Returns
    -------
    vertex : (v,) int64, the vertices of these cells
    uv : (v, 2) float64, mm

    References
    ----------
    Rabinovich et al., "Scalable Locally Injective Mappings", 2017.
    """
    q, kept = subset(p, chosen)
    start = tutte(q)
    uv = scaled(q, unfolded(q, arap(q, start, _RIGID)))
    for cell in np.flatnonzero(folded(q, uv) | ~simple(q, uv)).tolist():
        one, inside = subset(q, np.arange(q.n) == cell)
        uv[inside] = start[inside]
        for iterations in _ITERATIONS:
            found = scaled(one, _slim(one, start[inside], iterations))
            if not folded(one, found)[0] and simple(one, found)[0]:
                uv[inside] = found
                break
    return kept, uv


def _slim(p: Patches, uv: Floats, iterations: int) -> Floats:
    import igl

    none, nowhere = np.zeros(0, np.int32), np.asfortranarray(np.zeros((0, 2)))
    V, F = np.asfortranarray(p.V), np.asfortranarray(p.F.astype(np.int32))
    data = igl.slim_precompute(V, F, np.asfortranarray(uv), igl.SYMMETRIC_DIRICHLET, none, nowhere, 0.0)
    out = np.array(igl.slim_solve(data, iterations), np.float64, order="C")
    return out if np.isfinite(out).all() else uv
