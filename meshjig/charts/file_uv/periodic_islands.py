"""Islands of UVs that go around: a cut whose two sides lie one way apart is a closing line, not a seam."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.chart import Chart
from meshjig.charts.flatten.flatten import is_unflipped
from meshjig.mesh.halfedges import Edges, border_halfedges, next_halfedge
from meshjig.mesh.measure import face_areas

__all__ = ["closed_around"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_UV_STEP, _PERIOD_STEP = 2.0**-18, 2.0**-8  # mm, as in rings made anew
_SAME = 0.02  # of the period: ways between the sides that differ by less are one
_LEAST = 0.2  # of the root of the area; shorter ways join teeth, not the two ends of a strip


def closed_around(chart: Chart, e: Edges, within: float = 1e-3) -> Chart:
    """Let a chart repeat where it was cut along a line to be laid flat.

    The two sides of that line have the same shape in the plane, one way apart. The chart is turned so
    that the way lies along u, and rounded so that places a period apart differ by it exactly.

    Parameters
    ----------
    chart : Chart, without a period
    e : Edges, of the mesh
    within : float, share of the chart that may lie where its copies a period away do

    Returns
    -------
    Chart, with a period; the chart itself where it does not go around
    """
    here, there = _cut_inside(chart, e)
    way = chart.uv[there] - chart.uv[here]
    extent = float(np.sqrt(np.abs(face_areas(chart.uv, chart.corners)).sum()))
    long = np.linalg.norm(way, axis=1) > _LEAST * extent
    if not long.any():
        return chart
    way[way[:, 0] + 1e-3 * way[:, 1] < 0] *= -1  # of each cut both sides are listed
    typical = np.median(way[long], axis=0)
    length = float(np.linalg.norm(typical))
    closing = np.linalg.norm(way - typical, axis=1) <= _SAME * length
    if closing.sum() < 2 * 2:
        return chart
    c, s = way[closing].mean(0) / max(float(np.linalg.norm(way[closing].mean(0))), 1e-300)
    uv = chart.uv @ np.array([[c, -s], [s, c]])
    exact = max(1.0, np.rint(length / _PERIOD_STEP)) * _PERIOD_STEP
    uv = np.rint(uv * [exact / length, length / exact] / _UV_STEP) * _UV_STEP
    a, b = here[closing], there[closing]
    left = uv[a, 0] < uv[b, 0]
    uv[b[left]] = uv[a[left]] + [exact, 0.0]
    if not is_unflipped(uv, chart.corners) or _covered_twice(uv, chart.corners, exact) > within:
        return chart
    return Chart(chart.faces, uv, chart.corners, float(exact))


def _cut_inside(chart: Chart, e: Edges) -> tuple[Ints, Ints]:
    """Give the corners, rows of uv, that one vertex has on both sides of the chart's own cuts."""
    number = np.full(len(e.twin) // 3, -1)
    number[chart.faces] = np.arange(len(chart.faces))
    rim = border_halfedges(chart.corners)
    h = 3 * chart.faces[rim // 3] + rim % 3
    t = e.twin[h]
    inner = (t != h) & (number[t // 3] >= 0)
    rim, t = rim[inner], t[inner]
    mate = 3 * number[t // 3] + t % 3
    G = chart.corners.ravel()
    here = np.concatenate([G[rim], G[next_halfedge(rim)]])
    there = np.concatenate([G[next_halfedge(mate)], G[mate]])
    return here, there


def _covered_twice(uv: Floats, corners: Ints, period: float) -> float:
    """Give the share of a chart's area that its copies to the right lie on."""
    import shapely

    from meshjig.mesh.boundary_loops import border_loop

    own = shapely.Polygon(uv[border_loop(corners)])
    if not own.is_valid:
        return 1.0
    moves = range(1, int(np.ptp(uv[:, 0]) / period) + 1)
    common = [own.intersection(shapely.affinity.translate(own, k * period)).area for k in moves]
    return float(max(common, default=0.0) / own.area)
