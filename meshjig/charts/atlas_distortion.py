"""What an atlas is worth, measured on the full mesh and at the scale of tiles."""

from dataclasses import dataclass

import numpy as np

from meshjig.charts.distortion import FLAT_LIMITS, ring_is_simple, within_limits
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.boundary_loops import longest_loop
from meshjig.mesh.halfedges import next_halfedge
from meshjig.mesh.measure import edge_lengths, face_areas, face_sides, singular_values, sums
from meshjig.mesh.types import Atlas, Mesh

__all__ = ["AtlasDistortion", "ChartDistortion", "atlas_distortion", "seam_over_sqrt_area", "share_at_scale"]

_SCALE = 0.025  # of the root of the area: a quarter of a tile of a hundred


@dataclass(frozen=True)
class ChartDistortion:
    """One chart of an atlas."""

    faces: int
    area_mm2: float
    gate_share: float  # of the area within FLAT_LIMITS, face by face
    period_mm: float


@dataclass(frozen=True)
class AtlasDistortion:
    """How good the charts of an atlas are."""

    n_charts: int
    flips: int  # mirrored or empty faces
    gate_share: float  # of the area within FLAT_LIMITS both ways, at the scale of tiles and without noise
    gate_share_faces: float  # the same face by face, noise and all
    seam_over_sqrt_area: float  # length of all cuts but the closing lines of periodic charts
    overlaps: int  # charts whose border meets itself in the plane, or its copy a period away
    charts: list[ChartDistortion]


def atlas_distortion(atlas: Atlas, smoothed: Floats | None = None) -> AtlasDistortion:
    """Measure an atlas.

    Parameters
    ----------
    atlas : Atlas
    smoothed : (n, 3) float64, mm, the mesh's vertices without noise, where it has any

    Returns
    -------
    AtlasDistortion
    """
    (V, F), area, twin = atlas.mesh, atlas.mesh.areas, atlas.mesh.edges.twin
    good = within_limits(singular_values(V, F, atlas.uv, atlas.F_uv))
    n, chart = atlas.n_charts, atlas.chart_of_face
    is_rim = _is_rim(atlas, twin)
    V_even, side = V if smoothed is None else smoothed, _SCALE * float(np.sqrt(area.sum()))
    areas, goods = sums(chart, area, n), sums(chart, area * good, n)
    period = np.zeros(n) if atlas.period is None else atlas.period
    rows = zip(np.bincount(chart, minlength=n), areas, goods / np.maximum(areas, 1e-300), period, strict=True)
    return AtlasDistortion(
        n_charts=n,
        flips=int((face_areas(atlas.uv, atlas.F_uv) <= 0).sum()),
        gate_share=share_at_scale(V_even, F, atlas.uv, atlas.F_uv, side),
        gate_share_faces=float(area[good].sum() / area.sum()),
        seam_over_sqrt_area=seam_over_sqrt_area(atlas.mesh, _is_seam(atlas, is_rim, twin)),
        overlaps=sum(_overlaps(atlas, is_rim, number, float(p)) for number, p in enumerate(period)),
        charts=[ChartDistortion(int(k), float(a), float(g), float(p)) for k, a, g, p in rows],
    )


def seam_over_sqrt_area(mesh: Mesh, seam: Bools) -> float:
    """The length of seams over the root of the area.

    Parameters
    ----------
    mesh : Mesh
    seam : (3 m,) bool, half-edges on a seam; on either side or on both
    """
    twin, corner = mesh.edges.twin, mesh.F.ravel()
    h = np.flatnonzero((seam | seam[twin]) & (twin > np.arange(len(twin))))
    ends = np.stack([corner[h], corner[next_halfedge(h)]], 1)
    return float(edge_lengths(mesh.V, ends).sum() / np.sqrt(mesh.areas.sum()))


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


def share_at_scale(V: Floats, F: Ints, uv: Floats, F_uv: Ints, at: float) -> float:
    """The share of the area within FLAT_LIMITS, stretch averaged over squares of the plane.

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
    """The first fundamental form of good faces over the plane: E, F and G, (3, m)."""
    metric = np.empty((3, len(F)))
    for (some, d, e), (_, p, q) in zip(face_sides(V, F), face_sides(uv, F_uv), strict=True):
        det = np.where(good[some], p[0] * q[1] - p[1] * q[0], np.inf)
        along_u = [(x * q[1] - y * p[1]) / det for x, y in zip(d, e, strict=True)]
        along_v = [(y * p[0] - x * q[0]) / det for x, y in zip(d, e, strict=True)]
        for k, (a, b) in enumerate(((along_u, along_u), (along_u, along_v), (along_v, along_v))):
            metric[k, some] = sum(x * y for x, y in zip(a, b, strict=True))
    return metric
