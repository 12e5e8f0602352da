"""The region of the plane that a chart covers."""

from typing import Any

import numpy as np

from meshjig.mesh.halfedges import edge_keys, next_halfedge
from meshjig.mesh.types import Atlas, Floats, Ints

__all__ = ["chart_borders", "chart_periods", "chart_polygons", "unrolled"]


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
        rings = [shapely.Polygon(atlas.uv[loop]) for loop in _loops(start[mine], end[mine])]
        rings = [ring if ring.is_valid else ring.buffer(0) for ring in rings]
        rings.sort(key=lambda ring: -ring.area)
        outer = rings[0]
        for hole in rings[1:]:
            outer = outer.difference(hole)
        polygons.append(outer)
    return polygons


def chart_borders(F: Ints) -> Ints:
    """Give the half-edges without a twin, (b,) int64, for faces (m, 3) of charts.

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
    """Give the period of every chart, mm, 0 where it has none, (c,) float64."""
    return np.zeros(atlas.n_charts) if atlas.period is None else atlas.period


def unrolled(polygon: Any, period: float) -> Any:
    """Put a periodic chart between its copies, a period to either side; another stays as it is."""
    import shapely

    if not period:
        return polygon
    turns = np.array([(-period, 0.0), (0.0, 0.0), (period, 0.0)])
    return shapely.union_all([shapely.transform(polygon, lambda xy, by=by: xy + by) for by in turns])


def _loops(start: Ints, end: Ints) -> list[list[int]]:
    following = dict(zip(start.tolist(), end.tolist(), strict=True))
    loops = []
    while following:
        first, at = following.popitem()
        loop = [first]
        while at != first:
            loop.append(at)
            at = following.pop(at)
        loops.append(loop)
    return [loop for loop in loops if len(loop) > 2]
