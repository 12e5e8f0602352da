"""The region of the plane that a chart covers."""

from typing import Any

from meshjig.topology import border_halfedges, next_halfedge
from meshjig.types import Atlas, Ints

__all__ = ["chart_polygons"]


def chart_polygons(atlas: Atlas) -> list[Any]:
    """Draw every chart's outline.

    Returns
    -------
    list of shapely.Polygon, one a chart, mm; made valid where a chart's border crosses itself
    """
    import shapely

    F = atlas.F_uv
    h = border_halfedges(F)
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
