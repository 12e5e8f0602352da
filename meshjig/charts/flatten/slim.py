"""SLIM: bring a flattened chart near isometry, with no face ever mirrored on the way."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["slim"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def slim(V: Floats, F: Ints, uv: Floats, iterations: int) -> Floats:
    """Lower the symmetric Dirichlet energy of a chart.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm. The start: no face mirrored, or libigl silently answers it unchanged.
    iterations : int

    Returns
    -------
    uv : (n, 2) float64, mm. The start itself where the solver lost its footing.

    References
    ----------
    Rabinovich et al., "Scalable Locally Injective Mappings", 2017.
    """
    import igl

    none, nowhere = np.zeros(0, np.int32), np.asfortranarray(np.zeros((0, 2)))
    start = np.asfortranarray(uv)
    faces = np.asfortranarray(F.astype(np.int32))
    data = igl.slim_precompute(
        np.asfortranarray(V), faces, start, igl.SYMMETRIC_DIRICHLET, none, nowhere, 0.0
    )
    out = np.array(igl.slim_solve(data, iterations), np.float64, order="C")
    return out if np.isfinite(out).all() else uv
