"""Least-squares conformal maps: flatten a disc-shaped chart with its angles kept."""

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import ChartError
from meshjig.mesh.boundary_loops import border_loop
from meshjig.mesh.measure import face_areas

__all__ = ["lscm"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def lscm(V: Floats, F: Ints, border: Ints | None = None, area: float | None = None) -> Floats:
    """Flatten a chart so that angles survive and the area is the surface's own.

    Two far border vertices are pinned: LSCM is free up to a similarity, and libigl answers
    zeros when only one is pinned. Faces may come out mirrored; the caller checks.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    border : (b,) int64, its border loop, where the caller has it
    area : float, mm2, its area, where the caller has it

    Returns
    -------
    uv : (n, 2) float64, mm. Scaled so that the chart's area in the plane is its area in space.

    Raises
    ------
    ChartError
        The chart has no border, or its equations have no solution.

    References
    ----------
    Levy et al., "Least Squares Conformal Maps for Automatic Texture Atlas Generation", 2002.
    """
    import igl

    border = border_loop(F) if border is None else border
    if len(border) < 3:
        raise ChartError("a chart without a border can't be flattened", hint="cut it first")
    first = border[np.linalg.norm(V[border] - V[border].mean(0), axis=1).argmax()]
    reach = np.linalg.norm(V[border] - V[first], axis=1)
    if not reach.max() > 0:  # libigl would end the process
        raise ChartError("a chart's border is a single point", hint="repair its degenerate faces")
    pins = np.array([[0.0, 0.0], [reach.max(), 0.0]])
    uv, _ = igl.lscm(V, F, np.array([first, border[reach.argmax()]], np.int64), pins)
    flat = np.abs(face_areas(uv, F)).sum()
    if not np.isfinite(uv).all() or flat <= 0:
        raise ChartError("a chart has no conformal map", hint="repair its degenerate faces")
    area = float(face_areas(V, F).sum()) if area is None else area
    scaled: Floats = uv * np.sqrt(area / flat)
    return scaled
