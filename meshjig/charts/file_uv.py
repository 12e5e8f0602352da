"""Charts from the UVs that came with the file."""

from typing import Any

import numpy as np

from meshjig.charts.chart import Chart
from meshjig.charts.cuts import cut_open
from meshjig.charts.distortion import is_unflipped, unit_stretch
from meshjig.charts.flatten.untangle import separate_border, untangle
from meshjig.charts.regularize import regularize
from meshjig.charts.segment.clean_labels import clean_labels
from meshjig.charts.source_uv import SourceUV, are_connected, is_as_loaded, island_seams, sample, source_uv
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import Edges, border_halfedges, compact, next_halfedge
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.types import UV_GRID, Mesh

__all__ = ["closed_around", "file_uv"]

_MOST = 60  # islands that can make charts: tiles on smaller ones would nearly all be cut by seams
_NEXT_TO_NONE = 1e-6  # what the UV of a torn-off face counts, where other faces know better
_JUMP = 0.5  # of the texture: a face that reaches farther goes around its edge
_PERIOD_STEP = 2.0**-8  # mm
_SAME = 0.02  # of the period: shifts between the sides that differ by less are one
_LEAST = 0.2  # of the root of the area; shorter shifts join teeth, not the two ends of a strip


def file_uv(mesh: Mesh, source: Any, to_source: Floats) -> list[Chart]:
    """Make a chart of every island of a file's UVs.

    The mesh may have been repaired and decimated since: each face asks the source where it lies.

    Parameters
    ----------
    mesh : Mesh
    source : the mesh as loaded, with vertices, faces and look.uv
    to_source : (4, 4) float64, takes the mesh's coordinates to those of source

    Returns
    -------
    list of Chart
        Cut where the UVs are cut; mirrored islands are turned; the mean stretch of each is 1. An island
        whose cut joins two sides that lie one shift apart goes around: it has a period.

    Raises
    ------
    ChartError
        The UVs are missing, in too many islands, without area, folded or overlapping.
    """
    found = source_uv(source, to_source)
    n = int(found.island.max(initial=-1)) + 1
    if n > _MOST:
        raise ChartError(
            f"the file's UVs fall into {n} islands, and more than {_MOST} leave hardly a tile whole",
            hint="use --charts auto",
        )
    if not is_as_loaded(mesh.V, mesh.F, found).any():
        mesh = regularize(mesh)
    island, places = sample(mesh.V, mesh.F, found)
    if (island < 0).any() or not are_connected(mesh, island):
        island = clean_labels(mesh, island, mesh.areas)
    seam, torn = island_seams(mesh, island, places)
    corners, origin = cut_open(mesh.F, mesh.edges, seam)
    flat, weight = corners.ravel(), np.repeat(np.where(torn, _NEXT_TO_NONE, 1.0), 3)
    total = sums(flat, weight, len(origin))
    uv = np.stack([sums(flat, weight * places[..., k].ravel(), len(origin)) / total for k in (0, 1)], 1)
    n_charts, chart = components(corners)
    charts = [_chart(mesh, found, np.flatnonzero(chart == k), uv, corners, origin) for k in range(n_charts)]
    return [closed_around(chart, mesh.edges) for chart in charts]


def _chart(mesh: Mesh, source: SourceUV, faces: Ints, uv: Floats, corners: Ints, origin: Ints) -> Chart:
    """Turn, scale and check one island."""
    G, rows = compact(corners[faces])
    V, uv = mesh.V[origin[rows]], uv[rows]
    area = face_areas(uv, G)
    if area.sum() < 0:
        uv = uv * [-1.0, 1.0]
    x, y, z = np.average(mesh.V[mesh.F[faces]].mean(1), axis=0, weights=face_areas(V, G) + 1e-300)
    where = f"near ({x:.0f}, {y:.0f}, {z:.0f}) mm"
    if not np.abs(area).sum() > 0:
        raise ChartError(f"the file's UVs have no area {where}", hint="use --charts auto")
    uv = unit_stretch(V, G, uv)
    if not is_unflipped(uv, G):
        uv = untangle(V, G, uv)
    if not is_unflipped(uv, G):
        around = (np.ptp(source.uv[source.F], axis=1) > _JUMP).any()
        what = "go around the edge of the texture inside faces" if around else "fold"
        raise ChartError(f"the file's UVs {what} {where}", hint="use --charts auto")
    if _meets_itself(uv, G):  # teeth of a decimated border may cross
        uv = separate_border(V, G, uv)
    uv = unit_stretch(V, G, uv)
    if not is_unflipped(uv, G) or _meets_itself(uv, G):
        raise ChartError(f"the file's UVs overlap themselves {where}", hint="use --charts auto")
    return Chart(faces, uv, G)


def _meets_itself(uv: Floats, G: Ints) -> bool:
    """Tell whether border edges cross others that they share no end with."""
    import shapely

    h = border_halfedges(G)
    ends = np.stack([G.ravel()[h], np.roll(G, -1, 1).ravel()[h]], 1)
    segments = shapely.linestrings(uv[ends])
    a, b = shapely.STRtree(segments).query(segments, predicate="intersects")
    return bool((~(ends[a][:, :, None] == ends[b][:, None, :]).any((1, 2))).any())


def closed_around(chart: Chart, e: Edges, within: float = 1e-3) -> Chart:
    """Let a chart repeat where it was cut along a line to be laid flat.

    The two sides of that line have the same shape in the plane, one shift apart. The chart is turned so
    that the shift lies along u, and rounded so that places a period apart differ by it exactly.

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
    shift = chart.uv[there] - chart.uv[here]
    extent = float(np.sqrt(np.abs(face_areas(chart.uv, chart.corners)).sum()))
    long = np.linalg.norm(shift, axis=1) > _LEAST * extent
    if not long.any():
        return chart
    shift[shift[:, 0] + 1e-3 * shift[:, 1] < 0] *= -1  # of each cut both sides are listed
    typical = np.median(shift[long], axis=0)
    length = float(np.linalg.norm(typical))
    closing = np.linalg.norm(shift - typical, axis=1) <= _SAME * length
    if closing.sum() < 2 * 2:
        return chart
    c, s = shift[closing].mean(0) / max(float(np.linalg.norm(shift[closing].mean(0))), 1e-300)
    uv = chart.uv @ np.array([[c, -s], [s, c]])
    exact = max(1.0, np.rint(length / _PERIOD_STEP)) * _PERIOD_STEP
    uv = np.rint(uv * [exact / length, length / exact] / UV_GRID) * UV_GRID
    a, b = here[closing], there[closing]
    left = uv[a, 0] < uv[b, 0]
    uv[b[left]] = uv[a[left]] + [exact, 0.0]
    if not is_unflipped(uv, chart.corners) or _covered_twice(uv, chart.corners, exact) > within:
        return chart
    return Chart(chart.faces, uv, chart.corners, float(exact))


def _cut_inside(chart: Chart, e: Edges) -> tuple[Ints, Ints]:
    """The corners, rows of uv, that one vertex has on both sides of the chart's own cuts."""
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
    """The share of a chart's area that its copies to the right lie on."""
    import shapely

    from meshjig.mesh.boundary_loops import border_loop

    own = shapely.Polygon(uv[border_loop(corners)])
    if not own.is_valid:
        return 1.0
    moves = range(1, int(np.ptp(uv[:, 0]) / period) + 1)
    common = [own.intersection(shapely.affinity.translate(own, k * period)).area for k in moves]
    return float(max(common, default=0.0) / own.area)
