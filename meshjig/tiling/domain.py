"""The region of the plane that a chart covers, and how it is stretched there on the surface."""

from collections.abc import Callable
from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import closed_loops
from meshjig.mesh.halfedges import edge_keys, next_halfedge
from meshjig.mesh.types import Atlas

__all__ = ["Stretch", "chart_borders", "chart_periods", "chart_polygons", "chart_stretch", "unrolled"]

Stretch = Callable[[Floats, Floats], Floats]

WITHIN = (0.5, 2.0)  # what a face may tell; one beyond that is a sliver


def chart_polygons(atlas: Atlas) -> list[Any]:
    """Draw every chart's outline.

    Returns
    -------
    list of shapely.Polygon, one a chart, mm; made valid where a chart's border crosses itself
    """
    import shapely

    F = atlas.F_uv
    h = chart_borders(F)
    start, end = F.ravel()[h], F.ravel()[next_halfedge(h)]
    chart = atlas.chart_of_face[h // 3]
    polygons = []
    for c in range(atlas.n_charts):
        mine = chart == c
        first, after = start[mine][::-1], end[mine][::-1]
        loops = [first[loop] for loop in closed_loops(first, after) if len(loop) > 2]
        rings = [shapely.Polygon(atlas.uv[loop]) for loop in loops]
        rings = [ring if ring.is_valid else ring.buffer(0) for ring in rings]
        rings.sort(key=lambda ring: -ring.area)
        outer = rings[0]
        for hole in rings[1:]:
            outer = outer.difference(hole)
        polygons.append(outer)
    return polygons


def chart_borders(F: Ints) -> Ints:
    """List the half-edges without a twin, (b,) int64, for faces (m, 3) of charts.

    A vertex lies on a border where the edges that leave it don't end where those start that reach it.
    Only edges between such vertices are looked at, which is ten times faster than to pair them all.
    """
    following = F[:, [1, 2, 0]].ravel()
    n = int(F.max(initial=-1)) + 1
    name = (np.arange(n) * 2654435761 % 2**32).astype(np.float64)  # sums of names are exact
    balance = np.bincount(F.ravel(), name[following] - name[F[:, [2, 0, 1]].ravel()], n)
    open_ended = balance != 0
    h = np.flatnonzero(open_ended[F.ravel()] & open_ended[following])
    part = np.stack([F.ravel()[h], following[h]], 1)
    _, key = np.unique(edge_keys(part, n), return_inverse=True)
    return h[np.bincount(key)[key] == 1]


def chart_periods(atlas: Atlas) -> Floats:
    """The period of every chart, mm, 0 where it has none, (c,) float64."""
    return np.zeros(atlas.n_charts) if atlas.period is None else atlas.period


def unrolled(polygon: Any, period: float) -> Any:
    """Put a periodic chart between its copies, a period to either side; another stays as it is."""
    import shapely

    if not period:
        return polygon
    turns = np.array([(-period, 0.0), (0.0, 0.0), (period, 0.0)])
    return shapely.union_all([shapely.transform(polygon, lambda xy, by=by: xy + by) for by in turns])


def chart_stretch(atlas: Atlas, chart: int) -> Stretch:
    """Measure a chart's faces, to ask the nearest one.

    Parameters
    ----------
    atlas : Atlas
    chart : int

    Returns
    -------
    callable
        For points (k, 2) of the chart's plane, mm, and directions (k, 2) there: how many times as long as
        in the plane a short line is on the surface, (k,) float64. Points may be periods away.
    """
    from scipy.spatial import cKDTree

    faces = np.flatnonzero(atlas.chart_of_face == chart)
    flat = atlas.uv[atlas.F_uv[faces]]
    metric = _metrics(flat, atlas.mesh.V[atlas.mesh.F[faces]])
    tree, low = cKDTree(flat.mean(1)), flat[..., 0].min()
    period = 0.0 if atlas.period is None else float(atlas.period[chart])

    def stretch(points: Floats, directions: Floats) -> Floats:
        x = low + (points[:, 0] - low) % period if period else points[:, 0]
        M = metric[tree.query(np.column_stack([x, points[:, 1]]))[1]]
        squared = np.einsum("ki,kij,kj->k", directions, M, directions)
        length = np.maximum(np.linalg.norm(directions, axis=1), 1e-12)
        times: Floats = np.clip(np.sqrt(np.maximum(squared, 0.0)) / length, *WITHIN)
        return times

    return stretch


def _metrics(flat: Floats, solid: Floats) -> Floats:
    """The first fundamental forms (f, 2, 2) of faces from the plane (f, 3, 2) to space (f, 3, 3)."""
    A = (solid[:, 1:] - solid[:, :1]).transpose(0, 2, 1)
    (a, c), (b, d) = (flat[:, 1:] - flat[:, :1]).transpose(1, 2, 0)
    det = a * d - b * c
    inverse = np.array([[d, -b], [-c, a]]).transpose(2, 0, 1) / np.where(det == 0, np.inf, det)[:, None, None]
    J = A @ inverse
    return J.transpose(0, 2, 1) @ J
