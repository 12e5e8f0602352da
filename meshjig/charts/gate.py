"""How true to size charts are, judged at the scale of tiles: noise is no stretch."""

import numpy as np

from meshjig.charts.flatten import FLAT_LIMITS
from meshjig.measure import face_areas
from meshjig.types import Floats, Ints

__all__ = ["gate_share"]


def gate_share(V: Floats, F: Ints, uv: Floats, F_uv: Ints, at: float) -> float:
    """Give the share of the area within FLAT_LIMITS, stretch averaged over squares of the plane.

    What is averaged is the metric that the surface has in the plane, the first fundamental form: a rough
    face is longer than its chart, however it is turned, and the mean over a square tells by how much
    a tile's edge is. Roughness that is the same everywhere only makes the surface larger.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    uv : (k, 2) float64, mm
    F_uv : (m, 3) int64, corners into uv
    at : float, mm, edge of the squares

    Returns
    -------
    float, 0 to 1; faces without area in the plane count as outside
    """
    plane, area = face_areas(uv, F_uv), face_areas(V, F)
    good = plane > 1e-12 * plane.max(initial=0)
    metric = np.zeros((len(F), 3))
    metric[good] = _metric(V, F[good], uv, F_uv[good])
    place = np.floor((uv[F_uv[:, 0]] + uv[F_uv[:, 1]] + uv[F_uv[:, 2]]) / (3 * at)).astype(np.int64)
    place -= place.min(0)
    cell = place[:, 0] * (int(place[:, 1].max(initial=0)) + 1) + place[:, 1]
    weight = np.bincount(cell, plane * good)
    total = np.stack([np.bincount(cell, plane * metric[:, k]) for k in range(3)], 1)
    mean = total / np.maximum(weight, 1e-300)[:, None]
    middle, spread = (mean[:, 0] + mean[:, 2]) / 2, np.hypot((mean[:, 0] - mean[:, 2]) / 2, mean[:, 1])
    rough = max(float(area.sum() / max(plane[good].sum(), 1e-300)), 1.0)  # by noise, areas grow alike
    low = np.sqrt(np.maximum(middle - spread, 0.0) / rough)
    high = np.sqrt((middle + spread) / rough)
    within = (1 / np.maximum(high, 1e-9) >= FLAT_LIMITS[0]) & (1 / np.maximum(low, 1e-9) <= FLAT_LIMITS[1])
    return float(area[within[cell] & good].sum() / area.sum())


def _metric(V: Floats, F: Ints, uv: Floats, F_uv: Ints) -> Floats:
    """Give the first fundamental form of faces over the plane: E, F and G, (m, 3)."""
    d, e = (V[F[:, k]] - V[F[:, 0]] for k in (1, 2))
    p, q = (uv[F_uv[:, k]] - uv[F_uv[:, 0]] for k in (1, 2))
    det = (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0])[:, None]
    along_u = (d * q[:, 1:] - e * p[:, 1:]) / det
    along_v = (e * p[:, :1] - d * q[:, :1]) / det
    pairs = ((along_u, along_u), (along_u, along_v), (along_v, along_v))
    return np.stack([np.einsum("ij,ij->i", a, b) for a, b in pairs], 1)
