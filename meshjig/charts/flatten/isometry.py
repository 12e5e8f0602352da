"""Flattened charts brought nearer to isometry: as rigid as possible, or by SLIM."""

import numpy as np

from meshjig.mesh.arrays import Floats, Ints

__all__ = ["arap", "slim"]


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
