"""As-rigid-as-possible flattening: quick, near isometry; strongly curved charts may fold."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["arap"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def arap(V: Floats, F: Ints, uv: Floats, iterations: int = 20) -> Floats:
    """Turn a flattened chart into one whose faces are as near to rigid copies as they can be.

    Faces may come out mirrored; the caller checks.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm, the start
    iterations : int

    Returns
    -------
    uv : (n, 2) float64, mm

    References
    ----------
    Liu et al., "A Local/Global Approach to Mesh Parameterization", 2008.
    """
    import igl

    pin = np.array([0], np.int64)
    data = igl.ARAPData()
    data.max_iter = iterations
    igl.arap_precomputation(V, F, 2, pin, data)
    return np.array(igl.arap_solve(uv[pin], data, uv), np.float64, order="C")
