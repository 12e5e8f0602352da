"""First flattenings of a disc: least-squares conformal maps, and Tutte's embedding."""

import numpy as np

from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import border_loop
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas

__all__ = ["lscm", "tutte"]


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


def tutte(V: Floats, F: Ints) -> Floats:
    """Put the border on a circle and every other vertex at the mean of its neighbours.

    The shape is poor, but it is a valid start for maps that can't repair mirrored faces.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex

    Returns
    -------
    uv : (n, 2) float64, mm, on a disc of the chart's area

    References
    ----------
    Tutte, "How to Draw a Graph", 1963.
    """
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import splu

    border = border_loop(F)
    uv = np.zeros((len(V), 2))
    uv[border] = _circle(V[border]) * np.sqrt(face_areas(V, F).sum() / np.pi)
    free = np.setdiff1d(np.arange(len(V)), border)
    if len(free):
        E = edges(F).E
        W = coo_matrix((np.ones(len(E)), (E[:, 0], E[:, 1])), shape=(len(V), len(V)))
        W = (W + W.T).tocsr()
        L = (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()[free]
        solver = splu(L[:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        uv[free] = solver.solve(-(L[:, border] @ uv[border]))
    return uv


def _circle(loop: Floats) -> Floats:
    """Spread a loop's points on the unit circle by arc length; no two of them fall together."""
    length = np.linalg.norm(loop - np.roll(loop, -1, 0), axis=1)
    length = np.maximum(length, 0.05 * length.mean() + 1e-300)
    up_to = np.cumsum(length)
    angle = 2 * np.pi * (up_to - length) / length.sum()
    return np.stack([np.cos(angle), np.sin(angle)], 1)
