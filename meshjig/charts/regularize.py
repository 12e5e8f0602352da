"""Ready a mesh for flattening: faces without area get a little, noise is smoothed away."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.denoise import denoise
from meshjig.errors import ChartError
from meshjig.mesh.halfedges import Edges, edges
from meshjig.mesh.measure import edge_lengths, face_areas

__all__ = ["steady"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_THIN = 1e-6  # of the mean edge: a face of less height counts as one without area
_SHIFT = 1e-3  # of the mean edge


def steady(V: Floats, F: Ints, seed: int = 0, e: Edges | None = None) -> Floats:
    """Shift the corners of faces without area at random, by far less than an edge; smooth a noisy surface.

    A single such face leaves the equations of a chart without a solution. Noise counts as curvature,
    and mirrors faces when charts are carried over from a proxy.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    seed : int
    e : Edges, of F, where the caller has them

    Returns
    -------
    V : (n, 3) float64, mm. For flattening only; V itself where no face is thin and there is
        little noise.

    Raises
    ------
    ChartError
        The mesh has no extent, or a coordinate is not finite.
    """
    e = edges(F) if e is None else e
    side = edge_lengths(V, e.E)[e.edge_of_halfedge].reshape(-1, 3)
    edge = float(side.mean())
    if not np.isfinite(edge) or edge <= 0:
        raise ChartError("the mesh has no extent", hint="remove faces without area and points at infinity")
    thin = 2 * face_areas(V, F) < _THIN * edge * np.maximum(side.max(1), _THIN * edge)
    if not thin.any():
        return denoise(V, F, e)
    moved = np.unique(F[thin])
    out = V.copy()
    out[moved] += _SHIFT * edge * np.random.default_rng(seed).normal(size=(len(moved), 3))
    return denoise(out, F, e)
