"""What an atlas is worth, measured on the full mesh."""

from typing import Any

import numpy as np

from meshjig.charts.border import border_loop
from meshjig.charts.flatten import FLAT_LIMITS, border_is_simple
from meshjig.charts.gate import gate_share
from meshjig.measure import face_areas, singular_values, sums
from meshjig.topology import compact, edges, next_halfedge
from meshjig.types import Atlas, Bools, Floats, Ints

__all__ = ["quality", "seam_over_sqrt_area"]


_SCALE = 0.025  # of the root of the area: a quarter of a tile of a hundred


def quality(atlas: Atlas) -> dict[str, Any]:
    """Measure an atlas.

    Parameters
    ----------
    atlas : Atlas

    Returns
    -------
    dict with
        n_charts, flips (mirrored or empty faces), gate_share (share of the area whose stretch
        lies within FLAT_LIMITS both ways, at the scale of tiles), gate_share_faces (the same face by face,
        noise and all), seam_over_sqrt_area (length of all cuts over the root of the
        area; closing lines of periodic charts are none), overlaps (charts whose border meets itself in the
        plane, or its copy a period away), charts (for each: faces, area_mm2, gate_share, period_mm)
    """
    V, F = atlas.mesh.V, atlas.mesh.F
    area = face_areas(V, F)
    s = singular_values(V, F, atlas.uv, atlas.F_uv)
    good = (s[:, 1] >= FLAT_LIMITS[0]) & (s[:, 0] <= FLAT_LIMITS[1])
    n, chart = atlas.n_charts, atlas.chart_of_face
    areas, goods = sums(chart, area, n), sums(chart, area * good, n)
    period = np.zeros(n) if atlas.period is None else atlas.period
    rows = zip(np.bincount(chart, minlength=n), areas, goods / np.maximum(areas, 1e-300), period, strict=True)
    return {
        "n_charts": n,
        "flips": int((face_areas(atlas.uv, atlas.F_uv) <= 0).sum()),
        "gate_share": gate_share(V, F, atlas.uv, atlas.F_uv, _SCALE * float(np.sqrt(area.sum()))),
        "gate_share_faces": float(area[good].sum() / area.sum()),
        "seam_over_sqrt_area": seam_over_sqrt_area(V, F, _is_seam(atlas)),
        "overlaps": sum(_overlaps(atlas, number, float(p)) for number, p in enumerate(period)),
        "charts": [
            {"faces": int(k), "area_mm2": float(a), "gate_share": float(g), "period_mm": float(p)}
            for k, a, g, p in rows
        ],
    }


def seam_over_sqrt_area(V: Floats, F: Ints, seam: Bools) -> float:
    """Give the length of seams over the root of the area.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    seam : (3 m,) bool, half-edges on a seam; on either side or on both
    """
    twin = edges(F).twin
    h = np.flatnonzero((seam | seam[twin]) & (twin > np.arange(len(twin))))
    ends = V[F.ravel()[next_halfedge(h)]] - V[F.ravel()[h]]
    return float(np.linalg.norm(ends, axis=1).sum() / np.sqrt(face_areas(V, F).sum()))


def _is_seam(atlas: Atlas) -> Bools:
    """Tell which half-edges (3 m,) have their two sides apart in the plane, not counting whole periods."""
    twin, G = edges(atlas.mesh.F).twin, atlas.F_uv.ravel()
    h = np.arange(len(twin))
    seam = (edges(atlas.F_uv).twin == h) & (twin != h)
    if atlas.period is not None:
        rim = np.flatnonzero(seam)
        chart = atlas.chart_of_face[rim // 3]
        period = atlas.period[chart]
        apart = atlas.uv[G[rim]] - atlas.uv[G[next_halfedge(twin[rim])]]
        closing = (chart == atlas.chart_of_face[twin[rim] // 3]) & (period > 0)
        seam[rim] = ~(closing & (apart[:, 1] == 0) & (abs(apart[:, 0]) == period))
    return seam


def _overlaps(atlas: Atlas, number: int, period: float) -> bool:
    """Tell whether a chart's border meets itself, or the chart its copy a period away."""
    import shapely

    G, kept = compact(atlas.F_uv[atlas.chart_of_face == number])
    uv = atlas.uv[kept]
    if not border_is_simple(uv, G):
        return True
    if not period:
        return False
    own = shapely.Polygon(uv[border_loop(G)])
    copies = range(1, int(np.ptp(uv[:, 0]) / period) + 1)
    common = [own.intersection(shapely.affinity.translate(own, k * period)).area for k in copies]
    return bool(max(common, default=0.0) > 1e-9 * own.area)
