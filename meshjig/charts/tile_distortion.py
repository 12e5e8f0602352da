"""How true to size charts are, judged at the scale of tiles: noise is no stretch."""

import numpy as np

from meshjig.charts.flatten.flatten import FLAT_LIMITS
from meshjig.mesh.measure import face_areas, face_sides
from meshjig.mesh.types import Bools, Floats, Ints

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
    metric = _metric(V, F, uv, F_uv, good)
    column, row = (_squares(x, F_uv, 3 * at) for x in np.ascontiguousarray(uv.T))
    cell = column * (int(row.max(initial=0)) + 1) + row
    weight = np.bincount(cell, plane * good)
    total = np.stack([np.bincount(cell, plane * one) for one in metric], 1)
    mean = total / np.maximum(weight, 1e-300)[:, None]
    middle, spread = (mean[:, 0] + mean[:, 2]) / 2, np.hypot((mean[:, 0] - mean[:, 2]) / 2, mean[:, 1])
    rough = max(float(area.sum() / max(plane[good].sum(), 1e-300)), 1.0)  # by noise, areas grow alike
    low = np.sqrt(np.maximum(middle - spread, 0.0) / rough)
    high = np.sqrt((middle + spread) / rough)
    within = (1 / np.maximum(high, 1e-9) >= FLAT_LIMITS[0]) & (1 / np.maximum(low, 1e-9) <= FLAT_LIMITS[1])
    return float(area[within[cell] & good].sum() / area.sum())


def _squares(x: Floats, F: Ints, side: float) -> Ints:
    """Number the squares that faces' centres are in along one axis, from 0; (m,)."""
    place = np.floor((x.take(F[:, 0]) + x.take(F[:, 1]) + x.take(F[:, 2])) / side).astype(np.int64)
    return place - place.min()


def _metric(V: Floats, F: Ints, uv: Floats, F_uv: Ints, good: Bools) -> Floats:
    """Give the first fundamental form of good faces over the plane: E, F and G, (3, m)."""
    metric = np.empty((3, len(F)))
    for (some, d, e), (_, p, q) in zip(face_sides(V, F), face_sides(uv, F_uv), strict=True):
        det = np.where(good[some], p[0] * q[1] - p[1] * q[0], np.inf)
        along_u = [(x * q[1] - y * p[1]) / det for x, y in zip(d, e, strict=True)]
        along_v = [(y * p[0] - x * q[0]) / det for x, y in zip(d, e, strict=True)]
        for k, (a, b) in enumerate(((along_u, along_u), (along_u, along_v), (along_v, along_v))):
            metric[k, some] = sum(x * y for x, y in zip(a, b, strict=True))
    return metric
