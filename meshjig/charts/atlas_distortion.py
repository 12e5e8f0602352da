"""What an atlas is worth, measured on the full mesh."""

from typing import Any

import numpy as np

from meshjig.charts.flatten.flatten import FLAT_LIMITS, ring_is_simple
from meshjig.charts.tile_distortion import gate_share
from meshjig.mesh.boundary_loops import longest_loop
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.measure import edge_lengths, face_areas, singular_values, sums
from meshjig.mesh.types import Atlas, Bools, Floats, Ints

__all__ = ["quality", "seam_over_sqrt_area"]


_SCALE = 0.025  # of the root of the area: a quarter of a tile of a hundred


def quality(atlas: Atlas, smoothed: Floats | None = None, twin: Ints | None = None) -> dict[str, Any]:
    """Measure an atlas.

    Parameters
    ----------
    atlas : Atlas
    smoothed : (n, 3) float64, mm, the mesh's vertices without noise, where it has any
    twin : (3 m,) int64, of the mesh's half-edges, where the caller has them

    Returns
    -------
    dict with
        n_charts, flips (mirrored or empty faces), gate_share (share of the area whose stretch
        lies within FLAT_LIMITS both ways, at the scale of tiles and without noise), gate_share_faces (the
        same face by face, noise and all), seam_over_sqrt_area (length of all cuts over the root of the
        area; closing lines of periodic charts are none), overlaps (charts whose border meets itself in the
        plane, or its copy a period away), charts (for each: faces, area_mm2, gate_share, period_mm)
    """
    V, F = atlas.mesh.V, atlas.mesh.F
    area = face_areas(V, F)
    s = singular_values(V, F, atlas.uv, atlas.F_uv)
    good = (s[:, 1] >= FLAT_LIMITS[0]) & (s[:, 0] <= FLAT_LIMITS[1])
    n, chart = atlas.n_charts, atlas.chart_of_face
    twin = edges(F).twin if twin is None else twin
    is_rim = _is_rim(atlas, twin)
    V_even, side = V if smoothed is None else smoothed, _SCALE * float(np.sqrt(area.sum()))
    areas, goods = sums(chart, area, n), sums(chart, area * good, n)
    period = np.zeros(n) if atlas.period is None else atlas.period
    rows = zip(np.bincount(chart, minlength=n), areas, goods / np.maximum(areas, 1e-300), period, strict=True)
    return {
        "n_charts": n,
        "flips": int((face_areas(atlas.uv, atlas.F_uv) <= 0).sum()),
        "gate_share": gate_share(V_even, F, atlas.uv, atlas.F_uv, side),
        "gate_share_faces": float(area[good].sum() / area.sum()),
        "seam_over_sqrt_area": seam_over_sqrt_area(V, F, _is_seam(atlas, is_rim, twin), twin),
        "overlaps": sum(_overlaps(atlas, is_rim, number, float(p)) for number, p in enumerate(period)),
        "charts": [
            {"faces": int(k), "area_mm2": float(a), "gate_share": float(g), "period_mm": float(p)}
            for k, a, g, p in rows
        ],
    }


def seam_over_sqrt_area(V: Floats, F: Ints, seam: Bools, twin: Ints | None = None) -> float:
    """Give the length of seams over the root of the area.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    seam : (3 m,) bool, half-edges on a seam; on either side or on both
    twin : (3 m,) int64, of the half-edges, where the caller has them
    """
    twin = edges(F).twin if twin is None else twin
    h = np.flatnonzero((seam | seam[twin]) & (twin > np.arange(len(twin))))
    ends = np.stack([F.ravel()[h], F.ravel()[next_halfedge(h)]], 1)
    return float(edge_lengths(V, ends).sum() / np.sqrt(face_areas(V, F).sum()))


def _is_rim(atlas: Atlas, twin: Ints) -> Bools:
    """Tell which half-edges (3 m,) end a chart: where the mesh does, or the two sides lie apart."""
    start, end = atlas.F_uv.ravel(), np.roll(atlas.F_uv, -1, 1).ravel()
    rim: Bools = (start != end[twin]) | (end != start[twin])
    return rim


def _is_seam(atlas: Atlas, is_rim: Bools, twin: Ints) -> Bools:
    """Tell which half-edges (3 m,) have their two sides apart in the plane, not counting whole periods."""
    G = atlas.F_uv.ravel()
    seam = is_rim & (twin != np.arange(len(twin)))
    if atlas.period is not None:
        rim = np.flatnonzero(seam)
        chart = atlas.chart_of_face[rim // 3]
        period = atlas.period[chart]
        apart = atlas.uv[G[rim]] - atlas.uv[G[next_halfedge(twin[rim])]]
        closing = (chart == atlas.chart_of_face[twin[rim] // 3]) & (period > 0)
        seam[rim] = ~(closing & (apart[:, 1] == 0) & (abs(apart[:, 0]) == period))
    return seam


def _overlaps(atlas: Atlas, is_rim: Bools, number: int, period: float) -> bool:
    """Tell whether a chart's border meets itself, or the chart its copy a period away."""
    import shapely

    h = np.flatnonzero(is_rim)
    h = h[atlas.chart_of_face[h // 3] == number]
    corner = atlas.F_uv.ravel()
    ring = atlas.uv[longest_loop(corner[h], corner[next_halfedge(h)])]
    if not ring_is_simple(ring):
        return True
    if not period:
        return False
    own = shapely.Polygon(ring)
    copies = range(1, int(np.ptp(ring[:, 0]) / period) + 1)
    common = [own.intersection(shapely.affinity.translate(own, k * period)).area for k in copies]
    return bool(max(common, default=0.0) > 1e-9 * own.area)
